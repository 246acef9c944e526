// Finds pages by their ids, sentences and sections. The index is loaded when the field gets the focus first.
(() => {
  const page = document.documentElement;
  const root = document.currentScript.dataset.root;
  const field = document.getElementById("search");
  const found = document.getElementById("found");
  let chosen = -1;

  const load = () => {
    if (window.searchIndex || document.getElementById("index")) return;
    const script = document.createElement("script");
    script.id = "index";
    script.src = root + "search-index.js";
    script.addEventListener("load", () => {
      show();
      page.dataset.script = "ran";
    });
    document.head.append(script);
  };

  // The lower, the better: an id that is the query, one that begins with it, one that has it, a sentence, a section.
  const rank = (entry, words) => {
    const name = entry.n.toLowerCase();
    const all = `${name} ${entry.s.toLowerCase()} ${entry.w.toLowerCase()}`;
    if (!words.every((word) => all.includes(word))) return null;
    const query = words.join(" ");
    if (name === query) return 0;
    if (name.startsWith(query)) return 1;
    if (words.every((word) => name.includes(word))) return 2;
    return words.every((word) => entry.s.toLowerCase().includes(word)) ? 3 : 4;
  };

  const show = () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    found.replaceChildren();
    chosen = -1;
    if (words.length > 0 && window.searchIndex) {
      const ranked = window.searchIndex.map((entry) => [rank(entry, words), entry]).filter(([at]) => at !== null);
      ranked.sort(([a], [b]) => a - b);
      for (const [, entry] of ranked.slice(0, 30)) {
        const item = document.createElement("li");
        const link = document.createElement("a");
        const name = document.createElement("code");
        const sentence = document.createElement("small");
        link.href = root + entry.a;
        name.textContent = entry.n;
        sentence.textContent = ` ${entry.k}${entry.s ? ": " + entry.s : ""}`;
        link.append(name, sentence);
        item.append(link);
        found.append(item);
      }
      if (ranked.length === 0) {
        const item = document.createElement("li");
        item.textContent = "Nothing found.";
        found.append(item);
      }
    }
    found.hidden = words.length === 0 || !window.searchIndex;
  };

  const choose = (step) => {
    const links = [...found.querySelectorAll("a")];
    if (links.length === 0) return;
    chosen = (chosen + step + links.length) % links.length;
    links.forEach((link, at) => link.parentElement.classList.toggle("on", at === chosen));
    links[chosen].scrollIntoView({ block: "nearest" });
  };

  window.addEventListener("error", (event) => {
    page.dataset.error = event.message;
  });
  // A link can have the words: `index.html?q=M73`.
  const query = new URLSearchParams(location.search).get("q");
  if (query) {
    field.value = query;
    load();
  } else {
    page.dataset.script = "ran";
  }
  field.addEventListener("focus", load);
  field.addEventListener("input", () => { load(); show(); });
  field.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      choose(event.key === "ArrowDown" ? 1 : -1);
      event.preventDefault();
    } else if (event.key === "Escape") {
      found.hidden = true;
    }
  });
  field.form.addEventListener("submit", (event) => {
    event.preventDefault();
    const links = found.querySelectorAll("a");
    if (links.length > 0) location.href = links[Math.max(chosen, 0)].href;
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "/" && document.activeElement !== field) {
      field.focus();
      event.preventDefault();
    }
  });
})();
