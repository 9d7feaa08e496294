//! Signals, read like a file.

use std::io;
use std::os::fd::{AsFd, BorrowedFd};

use nix::sys::signal::{SigSet, Signal};
use nix::sys::signalfd::{SfdFlags, SignalFd};
use rustix::event::{PollFd, PollFlags, poll};
use rustix::time::Timespec;

/// Those that are handed on to the command.
const HANDED_ON: [Signal; 6] =
    [Signal::SIGINT, Signal::SIGQUIT, Signal::SIGTERM, Signal::SIGHUP, Signal::SIGUSR1, Signal::SIGUSR2];
/// `si_code` of a signal that the kernel sends, such as SIGINT by Ctrl-C.
const SI_KERNEL: i32 = 0x80;

/// The signals of this process, which do nothing by themselves any more.
pub(super) struct Signals(SignalFd);

/// A signal that came, or none.
#[derive(Clone, Copy)]
pub(super) struct Received(Option<(Signal, bool)>);

impl Signals {
    /// Blocks the signals; processes that are started have them blocked too.
    pub(super) fn block() -> io::Result<Self> {
        let all = all();
        all.thread_block()?;
        Ok(Self(SignalFd::with_flags(&all, SfdFlags::SFD_NONBLOCK | SfdFlags::SFD_CLOEXEC)?))
    }

    /// Waits for a signal.
    pub(super) fn wait(&self) -> io::Result<Received> {
        self.wait_beside(None, None).map(|(received, _)| received)
    }

    /// Waits for a signal, for bytes or the end of `beside`, or for the end of `time`. Second: whether `beside` has
    /// something to read.
    pub(super) fn wait_beside(
        &self,
        beside: Option<BorrowedFd<'_>>,
        time: Option<std::time::Duration>,
    ) -> io::Result<(Received, bool)> {
        let time = time.map(|time| Timespec {
            tv_sec: time.as_secs().try_into().unwrap_or(i64::MAX),
            tv_nsec: time.subsec_nanos().into(),
        });
        let mut waited = vec![PollFd::from_borrowed_fd(self.0.as_fd(), PollFlags::IN)];
        waited.extend(beside.map(|beside| PollFd::from_borrowed_fd(beside, PollFlags::IN)));
        match poll(&mut waited, time.as_ref()) {
            // A signal without a meaning here; whoever waits looks again.
            Err(rustix::io::Errno::INTR) => return Ok((Received(None), false)),
            ready => ready?,
        };
        let readable = waited.get(1).is_some_and(|beside| !beside.revents().is_empty());
        Ok((self.take()?, readable))
    }

    fn take(&self) -> io::Result<Received> {
        let Some(read) = self.0.read_signal()? else { return Ok(Received(None)) };
        let signal = i32::try_from(read.ssi_signo).ok().and_then(|number| Signal::try_from(number).ok());
        Ok(Received(signal.map(|signal| (signal, read.ssi_code == SI_KERNEL))))
    }
}

impl Received {
    /// The signal, if the command has to get it from us. A signal of the terminal comes to all processes of the job.
    pub(super) fn to_hand_on(self) -> Option<Signal> {
        let (signal, by_terminal) = self.0?;
        (HANDED_ON.contains(&signal) && !by_terminal).then_some(signal)
    }

    /// The signal, if it asks this process to end.
    pub(super) fn to_end(self) -> Option<Signal> {
        let (signal, _) = self.0?;
        let ends = [Signal::SIGINT, Signal::SIGQUIT, Signal::SIGTERM, Signal::SIGHUP];
        ends.contains(&signal).then_some(signal)
    }

    /// Whether it is the end of the parent.
    pub(super) fn is_parents_end(self) -> bool {
        self.0.is_some_and(|(signal, _)| signal == Signal::SIGIO)
    }
}

/// The signals do again what they did before [`Signals::block`].
pub(super) fn unblock() -> io::Result<()> {
    Ok(all().thread_unblock()?)
}

fn all() -> SigSet {
    HANDED_ON.into_iter().chain([Signal::SIGIO, Signal::SIGCHLD]).collect()
}

/// The same signal for functions of rustix.
pub(super) fn rustix_signal(signal: Signal) -> rustix::process::Signal {
    rustix::process::Signal::from_named_raw(signal as i32).unwrap_or(rustix::process::Signal::TERM)
}
