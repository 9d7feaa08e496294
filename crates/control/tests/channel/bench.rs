//! A twin that is a table, its server, and clients.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader, Write};
use std::ops::Range;
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration as Wait;

use control::messages::{
    AboutSentence, ActiveFault, ObjectReport, Refusal, SentenceRow, UnitReport, VariableReport,
};
use control::{Change, Publisher, Server, Socket, Twin, serve};
use serde_json::{Value, json};
use time::{Duration, Instant};

/// The kinds of records.
pub(crate) const KINDS: [&str; 5] = ["state", "event", "fault", "frame_fault", "carrier"];
/// A test that has no answer in this time has failed.
const PATIENCE: Wait = Wait::from_secs(60);

/// What the twin of the tests has.
#[derive(Default)]
pub(crate) struct Table {
    pub(crate) now: u64,
    pub(crate) orders: Vec<String>,
    pub(crate) holds: BTreeSet<String>,
    pub(crate) variables: BTreeMap<String, (u64, bool)>,
    pub(crate) faults: BTreeSet<String>,
    /// Conditions that were looked at.
    pub(crate) looks: u64,
    /// For how long frames have waited, and for how long they wait for a look.
    pub(crate) taken: Duration,
    pub(crate) look_takes: Duration,
}

struct TableTwin(Arc<Mutex<Table>>);

impl TableTwin {
    fn table(&self) -> MutexGuard<'_, Table> {
        self.0.lock().unwrap()
    }

    fn next(&self) -> Instant {
        let mut table = self.table();
        table.now += 1;
        Instant::from_nanos(table.now)
    }
}

impl Twin for TableTwin {
    type Look = String;

    fn now(&self) -> Instant {
        self.next()
    }

    fn time_taken(&self) -> Duration {
        self.table().taken
    }

    fn link(&self) -> &str {
        "udp:127.0.0.1:1"
    }

    fn count(&self) -> usize {
        40
    }

    fn order(&mut self, sentence: &str) -> Result<Instant, Refusal> {
        let Some(condition) = sentence.strip_prefix("make ") else {
            let nearest = vec!["make it true".to_owned()];
            return Err(Refusal {
                nearest,
                ..Refusal::new(format!("`{sentence}` is no order"), "make something")
            });
        };
        self.table().orders.push(sentence.to_owned());
        self.table().holds.insert(condition.to_owned());
        Ok(self.next())
    }

    fn look_for(&mut self, condition: &str, _within: Duration) -> Result<String, Refusal> {
        if condition.contains("master") {
            return Err(Refusal::new("another master is here", "units, CPU Units and variables"));
        }
        Ok(condition.to_owned())
    }

    fn look(&mut self, looks: &mut [&mut String]) -> (Instant, Vec<Result<(), String>>) {
        let at = self.next();
        let mut table = self.table();
        table.looks += 1;
        table.taken = table.taken + table.look_takes;
        let seen = |look: &&mut String| {
            if table.holds.contains(&***look) { Ok(()) } else { Err("not made".to_owned()) }
        };
        (at, looks.iter().map(seen).collect())
    }

    fn report(&mut self, units: Range<usize>) -> (Instant, Vec<UnitReport>) {
        let report = |position: usize| UnitReport {
            unit: position + 1,
            name: format!("N{}", position + 1),
            model: "table".to_owned(),
            power: true,
            state: "OP".to_owned(),
            error: false,
            al_status_code: "0x0000".to_owned(),
            al_status_name: None,
            indicators: BTreeMap::new(),
            errors: Vec::new(),
            mode: "RUN".to_owned(),
            link: BTreeMap::new(),
            counters: BTreeMap::new(),
        };
        (self.next(), units.map(report).collect())
    }

    fn read(&mut self, names: &[&str]) -> (Instant, Vec<Result<VariableReport, Refusal>>) {
        let at = self.next();
        let table = self.table();
        let read = |name: &&str| match table.variables.get(*name) {
            Some((value, forced)) => Ok(VariableReport {
                variable_type: "UINT".to_owned(),
                value: json!(value),
                validity: "valid".to_owned(),
                forced: *forced,
            }),
            None => Err(Refusal::unknown("variable", name, &["V1", "V2"])),
        };
        (at, names.iter().map(read).collect())
    }

    fn change(&mut self, changes: &[(&str, Change)]) -> Result<Instant, Refusal> {
        let at = self.next();
        let mut table = self.table();
        for (name, change) in changes {
            let Some(variable) = table.variables.get_mut(*name) else {
                return Err(Refusal::unknown("variable", name, &["V1", "V2"]));
            };
            match change {
                Change::Write(value) => variable.0 = value.as_u64().unwrap_or_default(),
                Change::Force(value) => *variable = (value.as_u64().unwrap_or_default(), true),
                Change::Release => variable.1 = false,
            }
        }
        Ok(at)
    }

    fn object(&mut self, unit_and_entry: &str) -> Result<(Instant, ObjectReport), Refusal> {
        let value = match unit_and_entry {
            "N1 1018:04" => json!(7),
            other => return Err(Refusal::new(format!("`{other}` is no entry"), "such as `N1 1018:04`")),
        };
        let (object, data_type, bytes) =
            (unit_and_entry.to_owned(), "U32".to_owned(), "07 00 00 00".to_owned());
        Ok((self.next(), ObjectReport { object, data_type, value, bytes }))
    }

    fn faults(&mut self) -> (Instant, Vec<ActiveFault>) {
        let fault = |name: &String| ActiveFault {
            clear: Some(name.clone()),
            sentence: format!("break {name}"),
            unit: Some(1),
            ends_at_ns: None,
            frames_seen: None,
            frames_met: None,
        };
        let at = self.next();
        (at, self.table().faults.iter().map(fault).collect())
    }

    fn clear(&mut self, fault: &str) -> Result<Instant, Refusal> {
        let at = self.next();
        match fault {
            "all" => self.table().faults.clear(),
            name if self.table().faults.remove(name) => {}
            name => return Err(Refusal::unknown("fault", name, &["storm", "all"])),
        }
        Ok(at)
    }

    fn sentences(&self) -> Vec<SentenceRow> {
        vec![SentenceRow {
            about: AboutSentence::Unit,
            verb: "do".to_owned(),
            pattern: "make {condition}".to_owned(),
            example: "make it true".to_owned(),
            meaning: "it is true from now on".to_owned(),
        }]
    }
}

/// A folder of a test, removed at its end.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("ectwin-control-{}-{name}", std::process::id()));
        std::fs::create_dir(&path).unwrap();
        Self(path)
    }

    pub(crate) fn socket(&self) -> PathBuf {
        self.0.join("twin.sock")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).unwrap();
    }
}

/// The server of a twin.
pub(crate) struct Bench {
    pub(crate) table: Arc<Mutex<Table>>,
    pub(crate) publisher: Publisher,
    server: Server,
    _folder: Folder,
}

impl Bench {
    pub(crate) fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        let variables = [("V1".to_owned(), (1, false)), ("V2".to_owned(), (2, false))].into();
        let faults = ["storm".to_owned()].into();
        let table = Arc::new(Mutex::new(Table { variables, faults, ..Table::default() }));
        let socket = Socket::bind(&folder.socket()).unwrap();
        let (server, publisher) = serve(socket, TableTwin(Arc::clone(&table)), KINDS).unwrap();
        Self { table, publisher, server, _folder: folder }
    }

    pub(crate) fn path(&self) -> PathBuf {
        self.server.path().to_owned()
    }

    /// Ends the server.
    pub(crate) fn end(self) {
        let Self { server, _folder, .. } = self;
        drop(server);
    }

    pub(crate) fn client(&self) -> Client {
        Client::connect(self.server.path())
    }

    /// Publishes a record of this kind.
    pub(crate) fn publish(&self, kind: &'static str, number: u64) {
        self.publisher.publish([(kind, json!({ "at_ns": number, "kind": kind }).to_string())]);
    }
}

/// A client that says lines and reads lines.
pub(crate) struct Client {
    pub(crate) stream: UnixStream,
    reader: BufReader<UnixStream>,
}

impl Client {
    pub(crate) fn connect(path: &Path) -> Self {
        let stream = UnixStream::connect(path).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let reader = BufReader::new(stream.try_clone().unwrap());
        Self { stream, reader }
    }

    pub(crate) fn say(&mut self, bytes: impl AsRef<[u8]>) {
        self.stream.write_all(bytes.as_ref()).unwrap();
    }

    pub(crate) fn request(&mut self, request: &Value) {
        self.say(format!("{request}\n"));
    }

    /// The next line.
    pub(crate) fn line(&mut self) -> Value {
        let mut line = String::new();
        assert_ne!(self.reader.read_line(&mut line).unwrap(), 0, "the server has closed the connection");
        serde_json::from_str(&line).unwrap()
    }

    /// The answer to a request that was just said.
    pub(crate) fn answer(&mut self, request: &Value) -> Value {
        self.request(request);
        self.line()
    }

    /// Whether the server has closed the connection.
    pub(crate) fn is_closed(&mut self) -> bool {
        self.reader.fill_buf().is_ok_and(<[u8]>::is_empty)
    }
}
