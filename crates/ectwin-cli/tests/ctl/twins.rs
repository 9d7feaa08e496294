//! Which twin is meant, and what is said if there is none, or several.

use std::fs;
use std::os::unix::net::UnixListener;
use std::thread;

use rustix::process::{Pid, Signal, kill_process};

use crate::bench::{Bench, ended};

#[test]
fn without_a_twin_the_exit_code_is_3() {
    let bench = Bench::new("none");
    let none = bench.ctl(&["status"]);
    assert_eq!(none.code, Some(3));
    assert!(
        none.stderr
            .starts_with("error: no twin with a control channel runs\nhelp: start one with `ectwin run"),
        "{none:?}"
    );
    let dead = bench.ctl(&["status", "--control", "/nowhere/twin.sock"]);
    assert_eq!(dead.code, Some(3));
    assert!(dead.stderr.starts_with("error: no twin answers at /nowhere/twin.sock: "), "{dead:?}");
    assert!(bench.document(&["status"])["problems"][0]["help"].is_string());
}

#[test]
fn of_several_twins_one_has_to_be_named_and_dead_ones_do_not_count() {
    let bench = Bench::new("several");
    let (first, second) = (bench.twin(), bench.twin());
    let several = bench.ctl(&["status"]);
    assert_eq!(several.code, Some(2), "{several:?}");
    for socket in [bench.socket(&first), bench.socket(&second)] {
        assert!(several.stderr.contains(&socket), "{several:?}");
        bench.told(&["--control", &socket, "expect", "unit 1 is in INIT"]);
        let named = ended(bench.command(&["ctl", "status"]).env("ECTWIN_CONTROL", &socket));
        assert_eq!(named.code, Some(0), "{named:?}");
    }
    let killed = bench.socket(&first);
    kill_process(Pid::from_raw(first.id().try_into().unwrap()).unwrap(), Signal::KILL).unwrap();
    drop(first);
    assert!(fs::symlink_metadata(killed).is_ok(), "its socket is left");
    bench.told(&["status"]);
}

#[test]
fn what_is_no_twin_is_named() {
    let bench = Bench::new("other");
    let path = bench.folder.join("other.sock");
    let listener = UnixListener::bind(&path).unwrap();
    let server = thread::spawn(move || {
        let (mut client, _) = listener.accept().unwrap();
        std::io::Write::write_all(&mut client, b"220 mail\r\n").unwrap();
        std::io::read_to_string(client).unwrap_or_default()
    });
    let other = bench.ctl(&["--control", path.to_str().unwrap(), "status"]);
    assert_eq!(other.code, Some(3));
    assert!(other.stderr.starts_with("error: what answers is not a twin: it says `220 mail`"), "{other:?}");
    server.join().unwrap();
}
