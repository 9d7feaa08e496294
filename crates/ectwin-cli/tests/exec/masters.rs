//! Real masters under `exec`: over an interface, over UDP, several at once, as an ordinary user.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use testbed::{python_with, skip};

use crate::{UNIT, exec, has_namespaces};

const EXCHANGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/masters/exchange.py");
/// Cycles of each exchange.
const CYCLES: &str = "500";

/// pysoem in OP on the interface from the environment.
fn exchange(command: &mut Command, python: &Path) -> (bool, String) {
    let script = format!("exec \"$0\" {EXCHANGE} \"$ECTWIN_INTERFACE\" 1 factory {CYCLES}");
    let output = command.args([UNIT, "--", "sh", "-c", &script]).arg(python).output().unwrap();
    let printed = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&printed).into_owned())
}

#[test]
fn pysoem_exchanges_four_times_at_once() {
    const TEST: &str = "masters::pysoem_exchanges_four_times_at_once";
    let Some(python) = python_with("pysoem") else { return skip(TEST, "no Python with pysoem") };
    if !has_namespaces(TEST) {
        return;
    }
    std::thread::scope(|scope| {
        let runs = [(); 4].map(|()| scope.spawn(|| exchange(&mut exec(&[]), &python)));
        for run in runs {
            let (passed, printed) = run.join().unwrap();
            assert!(passed && printed.contains("passed"), "{printed}");
        }
    });
}

/// The user of `nobody`: an ordinary one, who owns nothing.
const ORDINARY: [&str; 5] = ["--reuid=65534", "--regid=65534", "--clear-groups", "--bounding-set=-all", "--"];

#[test]
fn an_ordinary_user_needs_no_root() {
    const TEST: &str = "masters::an_ordinary_user_needs_no_root";
    if !has_namespaces(TEST) {
        return;
    }
    if !rustix::process::geteuid().is_root() {
        // Then all other tests are this one.
        return;
    }
    // The checkout can lie in a folder that others cannot enter.
    let folder = Path::new("/tmp").join(format!("ectwin-exec-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o755)).unwrap();
    for (from, name) in [(env!("CARGO_BIN_EXE_ectwin"), "ectwin"), (UNIT, "unit.toml")] {
        fs::copy(from, folder.join(name)).unwrap();
    }
    let sees = "ip -o link show \"$ECTWIN_INTERFACE\" && id -u && grep -E 'Cap(Eff|Inh)' /proc/self/status";
    let output = Command::new("setpriv")
        .args(ORDINARY)
        .arg(folder.join("ectwin"))
        .arg("exec")
        .arg(folder.join("unit.toml"))
        .args(["--", "sh", "-c", sees])
        .output()
        .unwrap();
    fs::remove_dir_all(&folder).unwrap();
    let (stdout, stderr) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{stdout}{stderr}");
    assert!(stdout.contains("ectwin0") && stdout.contains("\n65534\n"), "{stdout}");
    // CAP_NET_ADMIN and CAP_NET_RAW, and no other.
    for set in ["CapEff", "CapInh"] {
        assert!(stdout.contains(&format!("{set}:\t0000000000003000")), "{stdout}");
    }
}
