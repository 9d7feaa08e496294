//! The testbed itself: a cable connects two namespaces, and a child is read and ended.

use std::process::Command;

use ectwin_testbed::{MasterSide, Process, add_veth_pair, in_network_namespace};

#[test]
fn a_cable_has_its_other_end_in_the_namespace_of_the_master() {
    in_network_namespace("a_cable_has_its_other_end_in_the_namespace_of_the_master", || {
        add_veth_pair("here", "there");
        let mut look = Command::new("ip");
        look.args(["link", "show", "dev", "there", "up"]);
        let mut there = MasterSide::start("there", &look);
        assert_eq!(there.wait(), 0);
        let mut look = Process::start(Command::new("ip").args(["-brief", "link"]));
        assert!(look.wait_for_line("here").contains("here@"));
        assert!(look.wait().success());
    });
}

#[test]
fn a_child_is_read_line_by_line_and_interrupted() {
    let script =
        "trap 'echo interrupted; exit 5' INT; echo ready one; read -r line; echo got $line; read -r never";
    let mut child = Process::start(Command::new("sh").args(["-c", script]));
    assert_eq!(child.wait_for_line("ready"), "ready one");
    child.say("a word");
    assert_eq!(child.wait_for_line("got"), "got a word");
    child.interrupt();
    assert_eq!(child.wait_for_line("interrupted"), "interrupted");
    assert_eq!(child.wait().code(), Some(5));
}
