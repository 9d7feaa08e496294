//! The signals that end a campaign or a search before its end: what is there is written first.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag;

use crate::ending_signal::Signal;
use crate::failure::Failure;
use crate::signals::is_ignored;

/// Which signal has arrived, if any. The second one ends the process at once.
#[derive(Clone, Default)]
pub(crate) struct Interrupt(Arc<AtomicUsize>);

impl Interrupt {
    /// From now on. A signal that this process was started to ignore, as by `nohup` or `&`, stays ignored.
    pub(crate) fn watch() -> Result<Self, Failure> {
        Self::registered().map_err(|source| Failure::Refused {
            message: format!("signals cannot be received: {source}"),
            help: "start the command without limits on signals".to_owned(),
        })
    }

    fn registered() -> io::Result<Self> {
        let (interrupt, is_second) = (Self::default(), Arc::new(AtomicBool::new(false)));
        for signal in [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| !is_ignored(*signal)) {
            flag::register_conditional_default(signal, Arc::clone(&is_second))?;
            flag::register(signal, Arc::clone(&is_second))?;
            flag::register_usize(signal, Arc::clone(&interrupt.0), signal.unsigned_abs() as usize)?;
        }
        Ok(interrupt)
    }

    /// The signal that has arrived.
    pub(crate) fn signal(&self) -> Option<Signal> {
        let signal = i32::try_from(self.0.load(Ordering::Relaxed)).ok()?;
        (signal != 0).then(|| Signal::new(signal))
    }
}
