//! Preludes: `use = "common.toml"` takes the keys that a file leaves out from another file, and steps before its own.

use core::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

use user_file::{LineNumbers, Problem, Reader, Section, Wanted, read_toml};

use super::names::Names;
use super::parameters::{USE, WITH};
use super::places::{Origin, Places, Span};
use super::reader::{FileReader, span_of};
use super::rebase::rebase;
use super::values;
use crate::model::{Script, ScriptStep, in_order};
use crate::ready::{Draft, Files};

/// Maximum number of preludes that use each other in a row.
const DEPTH_MAX: usize = 16;

/// Maximum number of preludes that a scenario reads, one that is used twice counted twice: preludes that use several
/// others branch.
const PRELUDES_MAX: usize = 100;

/// The keys that a prelude can set.
const KEYS: &[&str] =
    &["title", "seed", "limit", "cycle", "cycle_phase", "calendar", "capture", "master", "units", "steps"];

/// A file with its preludes.
pub(super) struct Whole {
    pub(super) draft: Draft,
    pub(super) places: Places,
    /// The keys that are set.
    set: Vec<&'static str>,
}

/// Where a file is.
pub(super) struct Here<'h> {
    /// The preludes that use it, the outermost first, and the file itself; empty for the scenario.
    stack: &'h [String],
    read: &'h Read,
}

/// What a scenario has read of its preludes.
#[derive(Default)]
pub(super) struct Read {
    /// Number of preludes.
    count: Cell<usize>,
    /// Their mistakes, each with its place: one of a prelude that is used several times is reported once.
    mistakes: RefCell<BTreeSet<String>>,
}

impl<'h> Here<'h> {
    /// The scenario itself, which notes its preludes in `read`.
    pub(super) const fn scenario(read: &'h Read) -> Self {
        Self { stack: &[], read }
    }

    fn folder(&self) -> &Path {
        self.stack.last().and_then(|path| Path::new(path).parent()).unwrap_or(Path::new(""))
    }
}

/// Reads a file and its preludes.
pub(super) fn read_whole<'i>(
    (text, reader): (&str, &mut Reader<'_>),
    file: &Section<'_, 'i>,
    names: &Names<'_, 'i>,
    files: &mut dyn Files,
    here: &Here<'_>,
) -> Whole {
    if !here.stack.is_empty() {
        refuse_parameters(reader, file);
    } else if file.get(USE).is_none() {
        reader.require(file, "title", "`title = \"…\"`, what the scenario shows");
        reader.require(file, "steps", "`steps = […]`, what happens");
    }
    let mut file_reader = FileReader::new(text, reader);
    let draft = file_reader.draft(file, names);
    let places = file_reader.places;
    let set = KEYS.iter().copied().filter(|key| file.get(key).is_some()).collect();
    let mut whole = Whole { draft, places, set };
    rebase(&mut whole.draft.script, here.folder());
    let used = reader.value(file, USE, values::paths).map(|paths| paths.value);
    let span = span_of(file, USE);
    let line = LineNumbers::of(text).line(span.start);
    // Without a prelude it is unknown which units there are.
    whole.draft.is_whole &= used.is_some() || file.get(USE).is_none();
    let mut before = 0;
    for path in used.iter().flat_map(|paths| paths.list()) {
        let path = normal(&here.folder().join(path));
        match read_prelude(path, names, files, here) {
            Ok(prelude) => before = whole.add(prelude, before, &span, line),
            Err(mistakes) => {
                whole.draft.is_whole = false;
                let is_new = |message: &String| here.read.mistakes.borrow_mut().insert(message.clone());
                for message in mistakes.into_iter().filter(is_new) {
                    reader.refuse(span.clone(), Problem::new(message, ""));
                }
            }
        }
    }
    whole
}

/// The parameters of a scenario are those of its preludes too.
fn refuse_parameters(reader: &mut Reader<'_>, prelude: &Section<'_, '_>) {
    if let Some(value) = prelude.get(WITH) {
        let problem = Problem::new("a prelude has no parameters of its own", "");
        reader.refuse(value.span(), problem.with_help("`with` belongs into the scenario"));
    }
}

/// Reads a prelude; otherwise its mistakes, each with its place there.
fn read_prelude<'i>(
    path: String,
    names: &Names<'_, 'i>,
    files: &mut dyn Files,
    here: &Here<'_>,
) -> Result<Whole, Vec<String>> {
    if here.stack.contains(&path) {
        let circle = here.stack.iter().chain([&path]).map(String::as_str).collect::<Vec<_>>();
        return Err(vec![format!("preludes use each other in a circle: {}", circle.join(", "))]);
    }
    if here.stack.len() == DEPTH_MAX {
        return Err(vec![format!("{path}: more than {DEPTH_MAX} preludes use each other in a row")]);
    }
    if here.read.count.replace(here.read.count.get() + 1) >= PRELUDES_MAX {
        return Err(vec![format!("{path}: a scenario uses at most {PRELUDES_MAX} preludes, and theirs")]);
    }
    let text = files.text(&path, Wanted::Scenario);
    let text = text.map_err(|reason| vec![format!("the prelude {path} cannot be read: {reason}")])?;
    let stack: Vec<String> = here.stack.iter().cloned().chain([path.clone()]).collect();
    let whole = read_toml(&text, Wanted::Scenario, |reader, file| {
        Some(read_whole((&text, reader), file, names, files, &Here { stack: &stack, read: here.read }))
    });
    let mut whole = whole.map_err(|errors| {
        let words = errors.iter().map(|error| format!("{path}:{error}"));
        words.chain(user_file::and_more(errors.more())).collect::<Vec<_>>()
    })?;
    if in_order(&whole.draft.script.steps).iter().any(|step| matches!(step, ScriptStep::Random(_))) {
        return Err(vec![format!("{path}: a prelude has no random steps; they belong into the scenario")]);
    }
    whole.tell_origin(&path, &text);
    Ok(whole)
}

impl Whole {
    /// Its own steps are reported with their place in the prelude.
    fn tell_origin(&mut self, path: &str, text: &str) {
        let origin = Rc::new(Origin { path: path.to_owned(), text: text.to_owned() });
        for (places, written) in self.places.steps.iter_mut().zip(&mut self.draft.written) {
            if places.origin.is_none() {
                written.text = format!("{path}:{}: {}", written.line, written.text);
                places.origin = Some(Rc::clone(&origin));
            }
        }
    }

    /// Adds a prelude: its steps behind the first `before` entries, its keys if they are not set. Returns the number of
    /// entries from preludes.
    fn add(&mut self, prelude: Self, before: usize, span: &Span, line: usize) -> usize {
        let Self { draft: Draft { script, mut written, is_whole }, places, set } = prelude;
        let first = self.top_level(before);
        self.keys(script, &set, first, span);
        self.draft.is_whole &= is_whole;
        let count = written.len();
        written.iter_mut().for_each(|written| (written.line, written.bytes) = (line, span.clone()));
        self.draft.written.splice(before..before, written);
        let mut places = places.steps;
        places.iter_mut().for_each(|places| places.used_at = span.clone());
        self.places.steps.splice(before..before, places);
        before + count
    }

    /// The place in the list of steps of the entry with this number, groups and their steps counted.
    fn top_level(&self, entry: usize) -> usize {
        let mut entries = 0;
        let behind = |step: &ScriptStep| {
            let is_before = entries < entry;
            entries += in_order(core::slice::from_ref(step)).len();
            is_before
        };
        self.draft.script.steps.iter().map(behind).take_while(|is_before| *is_before).count()
    }

    fn keys(&mut self, from: Script, set: &[&'static str], first: usize, span: &Span) {
        let own = &mut self.draft.script;
        let Script { title, seed, limit, cycle, cycle_phase, calendar, capture, master, units, steps } = from;
        own.steps.splice(first..first, steps);
        for key in set.iter().copied() {
            if key == "steps" || self.set.contains(&key) {
                continue;
            }
            match key {
                "title" => own.title = title.clone(),
                "seed" => own.seed = seed,
                "limit" => (own.limit, self.places.limit) = (limit, span.clone()),
                "cycle" => (own.cycle, self.places.cycle) = (cycle, span.clone()),
                "cycle_phase" => (own.cycle_phase, self.places.cycle_phase) = (cycle_phase, span.clone()),
                "calendar" => own.calendar = calendar,
                "capture" => own.capture = capture.clone(),
                "master" => {
                    own.master = master.clone();
                    self.places.master.program = span.clone();
                    self.places.master.device_names = span.clone();
                    self.places.master.task_period = span.clone();
                }
                "units" => {
                    own.units = units.clone();
                    self.places.units = vec![span.clone(); own.units.len()];
                }
                _ => continue,
            }
            self.set.push(key);
        }
        if set.contains(&"steps") && !self.set.contains(&"steps") {
            self.set.push("steps");
        }
    }

    /// The keys that no file sets, although a scenario needs them.
    pub(super) fn missing(&self) -> Vec<&'static str> {
        ["title", "steps"].into_iter().filter(|key| !self.set.contains(key)).collect()
    }
}

/// A path without `.` and without `..` behind a folder.
fn normal(path: &Path) -> String {
    let mut normal = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(normal.components().next_back(), Some(Component::Normal(_))) => {
                normal.pop();
            }
            Component::ParentDir | Component::Normal(_) | Component::RootDir | Component::Prefix(_) => {
                normal.push(part);
            }
        }
    }
    if normal.as_os_str().is_empty() { ".".to_owned() } else { normal.display().to_string() }
}
