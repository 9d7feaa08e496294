//! Namespaces of a run: of processes, so that none is left behind; of the network, so that runs do not meet.

use std::fs;
use std::io;

use nix::mount::{MsFlags, mount};
use nix::sched::{CloneFlags, unshare};
use rustix::process::{Gid, Uid, getegid, geteuid};
use rustix::thread::{
    CapabilitySet, CapabilitySets, capabilities, configure_capability_in_ambient_set, set_capabilities,
};

use crate::failure::Failure;

/// What the first process inside needs, beside what the command keeps.
const TO_MOUNT: CapabilitySet = CapabilitySet::SYS_ADMIN;
/// What a master needs to open its interface.
const FOR_THE_NETWORK: [CapabilitySet; 2] = [CapabilitySet::NET_ADMIN, CapabilitySet::NET_RAW];

/// The namespaces that the next child of this process is born into.
pub(super) struct Namespaces {
    of_processes: bool,
}

impl Namespaces {
    /// With a network of its own; this needs no root where the kernel lets ordinary users have user namespaces.
    pub(super) fn enter_with_network() -> Result<Self, Failure> {
        let flags = CloneFlags::CLONE_NEWNET | CloneFlags::CLONE_NEWPID | CloneFlags::CLONE_NEWNS;
        enter(flags).map_err(not_permitted)?;
        Ok(Self { of_processes: true })
    }

    /// With the network of the system. Where the kernel refuses namespaces, there are none.
    pub(super) fn enter() -> Self {
        let entered = enter(CloneFlags::CLONE_NEWPID | CloneFlags::CLONE_NEWNS);
        if let Err(error) = &entered {
            tracing::debug!("no namespace of processes: {error}");
        }
        Self { of_processes: entered.is_ok() }
    }

    /// Whether the kernel ends all processes with the first one.
    pub(super) const fn has_processes(&self) -> bool {
        self.of_processes
    }
}

/// The system refuses a network namespace, or a cable in it.
pub(super) fn not_permitted(source: io::Error) -> Failure {
    let help = "use `--link udp`, or run it as root; Ubuntu permits it to ordinary users by \
                `sudo sysctl kernel.apparmor_restrict_unprivileged_userns=0`, and Docker by \
                `--cap-add SYS_ADMIN --cap-add NET_ADMIN --security-opt apparmor=unconfined`";
    Failure::Refused {
        message: format!("cannot make an interface in a network namespace: {source}"),
        help: help.to_owned(),
    }
}

fn enter(flags: CloneFlags) -> io::Result<()> {
    let (user, group) = (geteuid(), getegid());
    if user.is_root() && unshare(flags).is_ok() {
        return Ok(());
    }
    unshare(flags | CloneFlags::CLONE_NEWUSER)?;
    keep_names(user, group)?;
    inherit(&[&FOR_THE_NETWORK[..], &[TO_MOUNT]].concat())
}

/// The user is the same inside as outside, and so are the owners of files.
fn keep_names(user: Uid, group: Gid) -> io::Result<()> {
    // A kernel that is older than this rule has no such file.
    let _ = fs::write("/proc/self/setgroups", "deny");
    fs::write("/proc/self/uid_map", format!("{0} {0} 1", user.as_raw()))?;
    fs::write("/proc/self/gid_map", format!("{0} {0} 1", group.as_raw()))
}

/// Programs that this one starts have these capabilities too, within the namespaces.
fn inherit(kept: &[CapabilitySet]) -> io::Result<()> {
    let CapabilitySets { effective, permitted, .. } = capabilities(None)?;
    let inheritable = kept.iter().copied().fold(CapabilitySet::empty(), CapabilitySet::union);
    set_capabilities(None, CapabilitySets { effective, permitted, inheritable })?;
    kept.iter().try_for_each(|kept| configure_capability_in_ambient_set(*kept, true))?;
    Ok(())
}

/// The command does not need everything that the first process has.
pub(super) fn keep_only_the_network() {
    let lowered = capabilities(None).and_then(|sets| {
        set_capabilities(None, CapabilitySets { inheritable: sets.inheritable - TO_MOUNT, ..sets })
    });
    if let Err(error) = lowered {
        tracing::debug!("the command inherits more capabilities than it needs: {error}");
    }
}

/// Shows the processes of this namespace in /proc, and only here. A container can refuse it; then /proc shows others.
pub(super) fn show_processes() {
    let private = mount(None::<&str>, "/", None::<&str>, MsFlags::MS_REC | MsFlags::MS_PRIVATE, None::<&str>);
    let safe = MsFlags::MS_NOSUID | MsFlags::MS_NODEV | MsFlags::MS_NOEXEC;
    let shown = private.and_then(|()| mount(Some("proc"), "/proc", Some("proc"), safe, None::<&str>));
    if let Err(error) = shown {
        tracing::debug!("/proc shows the processes of the system: {error}");
    }
}
