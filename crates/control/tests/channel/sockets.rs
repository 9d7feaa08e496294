//! The socket: who reaches it, who has it, and what is left of it.

use std::fs;
use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::sync::Barrier;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use control::Socket;
use rustix::fs::Mode;

use crate::bench::{Bench, Folder};

/// A socket file whose process has ended.
fn dead_socket(path: &Path) {
    drop(UnixListener::bind(path).unwrap());
    assert!(UnixStream::connect(path).is_err());
}

fn refused(path: &Path) -> String {
    let error = Socket::bind(path).map(|_| ()).unwrap_err();
    format!("{error}; {}", error.help())
}

#[test]
fn only_the_user_reaches_it_from_the_first_moment_on() {
    let folder = Folder::new("mode");
    let path = folder.socket();
    rustix::process::umask(Mode::empty());
    let stop = AtomicBool::new(false);
    thread::scope(|scope| {
        let watching = scope.spawn(|| {
            let mut seen = 0;
            while !stop.load(Ordering::Relaxed) {
                if let Ok(file) = fs::symlink_metadata(&path) {
                    assert_eq!(file.permissions().mode() & 0o777, 0o600);
                    seen += 1;
                }
            }
            seen
        });
        for _ in 0..300 {
            let socket = Socket::bind(&path).unwrap();
            assert_eq!(fs::symlink_metadata(socket.path()).unwrap().permissions().mode() & 0o777, 0o600);
        }
        stop.store(true, Ordering::Relaxed);
        watching.join().unwrap();
    });
}

#[test]
fn a_second_twin_on_the_same_path_is_refused_and_the_first_one_goes_on() {
    let folder = Folder::new("second");
    let path = folder.socket();
    let first = Socket::bind(&path).unwrap();
    let words = refused(&path);
    assert!(
        words.starts_with(&format!("another twin uses the control socket {}", path.display())),
        "{words}"
    );
    assert!(words.contains("--control PATH"), "{words}");
    assert!(UnixStream::connect(first.path()).is_ok());
    drop(first);
    assert!(!path.exists(), "it is removed at the end");
}

#[test]
fn a_dead_socket_is_taken_over_by_one_of_those_that_start_at_the_same_time() {
    for round in 0..20 {
        let folder = Folder::new(&format!("dead_{round}"));
        let path = folder.socket();
        dead_socket(&path);
        let (begin, won) = (Barrier::new(8), AtomicUsize::new(0));
        let sockets: Vec<_> = thread::scope(|scope| {
            let starters: Vec<_> = (0..8)
                .map(|_| {
                    scope.spawn(|| {
                        begin.wait();
                        Socket::bind(&path).inspect(|_| {
                            won.fetch_add(1, Ordering::Relaxed);
                        })
                    })
                })
                .collect();
            starters.into_iter().map(|starter| starter.join().unwrap()).collect()
        });
        assert_eq!(won.load(Ordering::Relaxed), 1);
        assert!(UnixStream::connect(&path).is_ok());
        drop(sockets);
        assert!(!path.exists());
    }
}

#[test]
fn a_file_that_is_no_socket_is_kept() {
    let folder = Folder::new("file");
    let path = folder.socket();
    fs::write(&path, "precious").unwrap();
    assert!(refused(&path).contains("exists and is no socket"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "precious");
    fs::remove_file(&path).unwrap();
    dead_socket(&folder.0.join("other.sock"));
    std::os::unix::fs::symlink(folder.0.join("other.sock"), &path).unwrap();
    assert!(refused(&path).contains("exists and is no socket"), "a link is none");
}

#[test]
fn the_socket_of_another_one_is_not_removed() {
    let folder = Folder::new("another");
    let path = folder.socket();
    let socket = Socket::bind(&path).unwrap();
    let own = fs::symlink_metadata(&path).unwrap().ino();
    fs::rename(&path, folder.0.join("moved.sock")).unwrap();
    let _other = UnixListener::bind(&path).unwrap();
    drop(socket);
    let file = fs::symlink_metadata(&path).unwrap();
    assert!(file.file_type().is_socket() && file.ino() != own);
}

#[test]
fn a_path_that_is_too_long_and_a_folder_that_is_not_there_have_a_way_out() {
    let folder = Folder::new("paths");
    let long = folder.0.join("x".repeat(120));
    let words = refused(&long);
    assert!(words.contains("at most 107; choose a shorter path"), "{words}");
    let words = refused(&folder.0.join("none/twin.sock"));
    assert!(words.contains("No such file or directory") && words.contains("a folder that exists"), "{words}");
}

#[test]
fn the_end_of_the_server_closes_the_connections_and_removes_the_socket() {
    let bench = Bench::new("end");
    let mut client = bench.client();
    assert_eq!(client.answer(&serde_json::json!({ "do": "make it" }))["ok"], true);
    let path = bench.path();
    let table = std::sync::Arc::clone(&bench.table);
    bench.end();
    assert!(client.is_closed());
    assert!(!path.exists());
    assert_eq!(std::sync::Arc::strong_count(&table), 1, "both threads have ended");
}
