//! Long sequences of small items. Only a few pages of each are in memory.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::fmt;
use std::rc::Rc;

use gaugeblock_vocabulary::motion::SamplesError;

/// Items of a page.
const PAGE_ITEMS: usize = 1024;
/// Most pages of a sequence that are in memory, if it has a store.
pub(super) const PAGES_IN_MEMORY: usize = 16;

/// Keeps the pages that memory has no room for, such as a temporary file. The caller supplies it.
pub trait PageStore {
    /// Appends a page, and returns its place.
    ///
    /// # Errors
    /// Why it cannot be written.
    fn append(&mut self, bytes: &[u8]) -> Result<u64, String>;

    /// Replaces a page by one of the same length.
    ///
    /// # Errors
    /// Why it cannot be written.
    fn replace(&mut self, place: u64, bytes: &[u8]) -> Result<(), String>;

    /// Reads a page.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn read(&mut self, place: u64, bytes: &mut [u8]) -> Result<(), String>;
}

/// Why samples are not recorded or read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RecordingError {
    /// A row that no table of samples has.
    Row(SamplesError),
    /// The store failed; the reason.
    Store(String),
}

impl fmt::Display for RecordingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Row(error) => error.fmt(f),
            Self::Store(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for RecordingError {}

/// What the sequences of a recording share: the store, if there is one, and its first error. After an error nothing
/// that was read counts; the error is reported at the end.
#[derive(Clone)]
pub(in crate::motion) struct Storage {
    has_store: bool,
    shared: Rc<RefCell<Shared>>,
}

struct Shared {
    store: Option<Box<dyn PageStore>>,
    error: Option<String>,
    /// Pages in memory: now, and at most so far.
    pages: (usize, usize),
}

impl Storage {
    pub(in crate::motion) fn of(store: Option<Box<dyn PageStore>>) -> Self {
        let has_store = store.is_some();
        let shared = Shared { store, error: None, pages: (0, 0) };
        Self { has_store, shared: Rc::new(RefCell::new(shared)) }
    }

    /// The first error so far.
    pub(in crate::motion) fn check(&self) -> Result<(), RecordingError> {
        match &self.shared.borrow().error {
            Some(why) => Err(RecordingError::Store(why.clone())),
            None => Ok(()),
        }
    }

    /// The greatest number of items of all sequences that were in memory at once.
    pub(in crate::motion) fn most_in_memory(&self) -> usize {
        self.shared.borrow().pages.1 * PAGE_ITEMS
    }

    fn page_comes(&self) {
        let mut shared = self.shared.borrow_mut();
        shared.pages.0 += 1;
        shared.pages.1 = shared.pages.1.max(shared.pages.0);
    }

    fn pages_leave(&self, count: usize) {
        let pages = &mut self.shared.borrow_mut().pages;
        pages.0 = pages.0.saturating_sub(count);
    }

    /// Calls the store; nothing if that fails, or failed before.
    fn call<T>(&self, act: impl FnOnce(&mut dyn PageStore) -> Result<T, String>) -> Option<T> {
        let mut shared = self.shared.borrow_mut();
        if shared.error.is_some() {
            return None;
        }
        match act(shared.store.as_mut()?.as_mut()) {
            Ok(done) => Some(done),
            Err(error) => {
                shared.error = Some(error);
                None
            }
        }
    }
}

impl fmt::Debug for Storage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Storage").field("has_store", &self.has_store).finish_non_exhaustive()
    }
}

/// How the items of a sequence are written. All take the same number of bytes.
pub(in crate::motion) trait Form {
    /// What an item is. Its default is what a place holds that was never set.
    type Item: Copy + Default;

    /// Appends the bytes of an item.
    fn write(&self, item: &Self::Item, bytes: &mut Vec<u8>);

    /// Reads an item back.
    fn read(&self, bytes: &mut Bytes<'_>) -> Self::Item;
}

/// Bytes of a page, read one item after the other. A page that is cut short reads as zeros.
pub(in crate::motion) struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let Some((taken, rest)) = self.0.split_first_chunk::<N>() else { return [0; N] };
        self.0 = rest;
        *taken
    }

    pub(in crate::motion) fn number(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    pub(in crate::motion) fn count(&mut self) -> usize {
        usize::try_from(u64::from_le_bytes(self.take())).unwrap_or(usize::MAX)
    }
}

/// Appends a count, as [`Bytes::count`] reads it.
pub(in crate::motion) fn write_count(count: usize, bytes: &mut Vec<u8>) {
    bytes.extend((count as u64).to_le_bytes());
}

/// The form of a number.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Number;

impl Form for Number {
    type Item = f64;

    fn write(&self, item: &f64, bytes: &mut Vec<u8>) {
        bytes.extend(item.to_le_bytes());
    }

    fn read(&self, bytes: &mut Bytes<'_>) -> f64 {
        bytes.number()
    }
}

/// The form of a count.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Count;

impl Form for Count {
    type Item = usize;

    fn write(&self, item: &usize, bytes: &mut Vec<u8>) {
        write_count(*item, bytes);
    }

    fn read(&self, bytes: &mut Bytes<'_>) -> usize {
        bytes.count()
    }
}

/// A sequence of items in pages. Without a store all of them are in memory.
#[derive(Debug)]
pub(in crate::motion) struct Paged<F: Form> {
    form: F,
    storage: Storage,
    len: usize,
    pages: RefCell<Pages<F::Item>>,
}

#[derive(Debug)]
struct Pages<T> {
    all: Vec<Page<T>>,
    /// The pages in memory, the oldest first.
    in_memory: VecDeque<usize>,
}

#[derive(Debug)]
struct Page<T> {
    items: Option<Box<[T]>>,
    /// Where the store has it, once it was written.
    place: Option<u64>,
    is_changed: bool,
}

impl<F: Form> Paged<F> {
    pub(in crate::motion) fn new(form: F, storage: &Storage) -> Self {
        let pages = Pages { all: Vec::new(), in_memory: VecDeque::new() };
        Self { form, storage: storage.clone(), len: 0, pages: RefCell::new(pages) }
    }

    /// A sequence of so many default items.
    pub(in crate::motion) fn filled(form: F, storage: &Storage, len: usize) -> Self {
        let mut filled = Self::new(form, storage);
        filled.len = len;
        filled
    }

    pub(in crate::motion) fn form(&self) -> &F {
        &self.form
    }

    pub(in crate::motion) fn len(&self) -> usize {
        self.len
    }

    pub(in crate::motion) fn push(&mut self, item: F::Item) {
        let place = self.len;
        self.len += 1;
        self.set(place, item);
    }

    pub(in crate::motion) fn set(&mut self, place: usize, item: F::Item) {
        let mut pages = self.pages.borrow_mut();
        let (page, at) = (place / PAGE_ITEMS, place % PAGE_ITEMS);
        self.bring(&mut pages, page);
        let page = &mut pages.all[page];
        if let Some(items) = &mut page.items {
            items[at] = item;
            page.is_changed = true;
        }
    }

    /// An item; a place that was never set has the default.
    pub(in crate::motion) fn get(&self, place: usize) -> F::Item {
        let (page, at) = (place / PAGE_ITEMS, place % PAGE_ITEMS);
        let mut pages = self.pages.borrow_mut();
        if pages.all.get(page).is_none_or(|page| page.items.is_none()) {
            self.bring(&mut pages, page);
        }
        pages.all[page].items.as_ref().map_or_else(F::Item::default, |items| items[at])
    }

    pub(in crate::motion) fn iter(&self) -> impl Iterator<Item = F::Item> + '_ {
        (0..self.len).map(|place| self.get(place))
    }

    /// Brings a page into memory; if there are too many, the oldest one leaves it.
    fn bring(&self, pages: &mut Pages<F::Item>, number: usize) {
        while pages.all.len() <= number {
            pages.all.push(Page { items: None, place: None, is_changed: false });
        }
        if pages.all[number].items.is_some() {
            return;
        }
        if self.storage.has_store && pages.in_memory.len() >= PAGES_IN_MEMORY {
            self.leave(pages);
        }
        let items = pages.all[number].place.and_then(|place| self.read(place));
        let items = items.unwrap_or_else(|| vec![F::Item::default(); PAGE_ITEMS].into());
        pages.all[number].items = Some(items);
        pages.in_memory.push_back(number);
        self.storage.page_comes();
    }

    fn leave(&self, pages: &mut Pages<F::Item>) {
        let Some(oldest) = pages.in_memory.pop_front() else { return };
        self.storage.pages_leave(1);
        let page = &mut pages.all[oldest];
        let Some(items) = page.items.take().filter(|_| page.is_changed) else { return };
        let mut bytes = Vec::with_capacity(PAGE_ITEMS * size_of::<F::Item>());
        for item in &items {
            self.form.write(item, &mut bytes);
        }
        page.is_changed = false;
        let place = page.place;
        page.place = self.storage.call(|store| match place {
            Some(place) => store.replace(place, &bytes).map(|()| place),
            None => store.append(&bytes),
        });
    }

    fn read(&self, place: u64) -> Option<Box<[F::Item]>> {
        let mut bytes = Vec::new();
        self.form.write(&F::Item::default(), &mut bytes);
        bytes.resize(bytes.len() * PAGE_ITEMS, 0);
        self.storage.call(|store| store.read(place, &mut bytes))?;
        let mut bytes = Bytes(&bytes);
        Some((0..PAGE_ITEMS).map(|_| self.form.read(&mut bytes)).collect())
    }
}

impl<F: Form> Drop for Paged<F> {
    fn drop(&mut self) {
        self.storage.pages_leave(self.pages.get_mut().in_memory.len());
    }
}
