// An adapter for Gaugeblock, protocol 1, of an interpreter in a library that calls canonical functions.
// c++ -std=c++17 -Wall -o adapter adapter.cpp; `gaugeblock adapter protocol` has the rest.
#include <cstdio>
#include <cstring>
#include <iostream>
#include <sstream>
#include <string>
static const char *const DECLARATION =
    R"("hello":{"protocol":1,"name":"toy in C++","version":"0.1","languages":["rs274"],"units":["mm","inch"],"features":[],)"
    R"("observables":{"fields":["position"],"fields_at_effects":[],"effects":["straight_traverse","straight_feed"],)"
    R"("moves_in_place":true,"fault_kinds":false,"final_parameters":false,"pins":[]},"resolution":0,"clock":"virtual",)"
    R"("language":{"g":["0","1","21"],"m":["2"],"axes":"XYZ","letters":"F","parameters":[],"expressions":false,)"
    R"("o_words":false,"comments":[]}})"; // it runs no more

struct Canon { // The canonical functions, which the interpreter calls: each adds an effect to those of the block.
    std::string effects, point = R"({"x":0,"y":0,"z":0})";
    void move(const char *effect, double x, double y, double z) {
        char json[99];
        std::snprintf(json, sizeof json, R"({"x":%.17g,"y":%.17g,"z":%.17g})", x, y, z), point = json;
        effects += (effects.empty() ? "" : ",") + (R"({"do":{"effect":")" + std::string(effect)) + R"(","end":)" + point + "}}";
    }
    void STRAIGHT_TRAVERSE(double x, double y, double z) { move("straight_traverse", x, y, z); }
    void STRAIGHT_FEED(double x, double y, double z) { move("straight_feed", x, y, z); }
};
struct Interpreter { // Replace it by yours. This one knows G0, G1, G21, F and M2, and throws why it refuses a block.
    double at[3] = {0, 0, 0}, motion = -1, feed = 0;
    bool execute(const std::string &block, Canon &canon) { // True at the end of the program.
        std::istringstream words(block);
        double number, moves = 0, ends = 0;
        for (char letter = 0; words >> letter;) {
            if (!(words >> number) || !std::strchr("gmfxyz", letter)) throw "unknown word";
            if ((letter == 'g' && number != 0 && number != 1 && number != 21) || (letter == 'm' && number != 2)) throw "unknown code";
            if (letter >= 'x') at[letter - 'x'] = number, moves = 1;
            if (letter == 'g' && number < 2) motion = number;
            if (letter == 'f') feed = number; else ends += letter == 'm';
        }
        if (moves && (motion < 0 || (motion == 1 && feed <= 0))) throw "no motion mode, or no feed";
        if (moves) motion == 0 ? canon.STRAIGHT_TRAVERSE(at[0], at[1], at[2]) : canon.STRAIGHT_FEED(at[0], at[1], at[2]);
        return ends > 0;
    }
};
static std::string run(std::istringstream program, Interpreter interpreter = {}, Canon canon = {}) {
    std::string text, block, steps, end = "percent_end";
    for (int line = 1; end == "percent_end" && std::getline(program, text); line++) try {
        block = R"("block":{"file":"main.ngc","line":)" + std::to_string(line) + "}", canon.effects = "";
        end = interpreter.execute(text, canon) ? "program_end" : "percent_end";
        steps += (line > 1 ? ",{" : "{") + block + R"(,"events":[)" + canon.effects + R"(],"state":{"language":"rs274","position":)" + canon.point + "}}";
    } catch (const char *message) { end = R"(fault",)" + block + R"(,"message":")" + message; }
    return R"("outcome":{"language":"rs274","start":{},"steps":[)" + steps + R"(],"end":{"end":")" + end + R"("}})";
}
int main() {
    for (std::string line; std::getline(std::cin, line) && !line.empty();) { // A real adapter takes a JSON library.
        const auto is = [&](const char *op) { return line.find(R"("op":")" + std::string(op)) != std::string::npos; };
        const auto from = line.find(R"("main":")") + 8, to = line.find('"', from);
        std::string main = is("run") ? line.substr(from, to - from) : "";
        for (size_t at; (at = main.find("\\n")) != std::string::npos;) main.replace(at, 2, "\n");
        std::cout << R"({"id":)" << std::stol(line.substr(line.find(R"("id":)") + 5)) << ",";
        std::cout << (is("hello") ? DECLARATION : is("run") ? run(std::istringstream(main)) : is("reset") || is("bye") ? R"("done":{})" : R"("refused":"?")") << "}" << std::endl;
    }
}
