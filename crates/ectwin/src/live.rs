//! A line of units that answers a link on threads of its own, for tests.

use std::io;
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread::{self, JoinHandle};

use link::{Clock, FramePort, Statistics};
use storage::ChangesLost;

use crate::Twin;
use crate::runtime::{Ended, Handle, Runtime};

impl Twin {
    /// Answers `port` in real time on separate threads, from the present time on.
    ///
    /// # Errors
    /// No thread can be started.
    pub fn serve(self, mut port: impl FramePort + 'static) -> io::Result<Live> {
        let clock = Clock::start_at(self.now());
        let runtime = Runtime::start(self, clock, Arc::new(AtomicBool::new(false)))?;
        let handle = runtime.handle();
        let units = thread::Builder::new().name("units".to_owned());
        let units = units.spawn(move || runtime.answer(&mut port, None))?;
        Ok(Live { handle, units: Some(units) })
    }

    /// Answers an ethercrab master in this process, with the halves of its `PduStorage`.
    ///
    /// # Errors
    /// No thread can be started.
    #[cfg(feature = "ethercrab")]
    pub fn serve_ethercrab(
        self,
        tx: ethercrab::PduTx<'static>,
        rx: ethercrab::PduRx<'static>,
    ) -> io::Result<Live> {
        self.serve(crate::EthercrabPort::new(tx, rx))
    }
}

/// A line of units that answers a link, with the access of its [`Handle`]. Dropping it switches the units off.
#[derive(Debug)]
pub struct Live {
    handle: Handle,
    units: Option<JoinHandle<io::Result<Ended>>>,
}

impl Deref for Live {
    type Target = Handle;

    fn deref(&self) -> &Handle {
        &self.handle
    }
}

impl Live {
    /// Access to the units from other threads.
    #[must_use]
    pub fn handle(&self) -> Handle {
        self.handle.clone()
    }

    /// Switches the units off and returns their statistics.
    ///
    /// # Errors
    /// The medium was gone, or the last changes of a unit could not be stored in its memory file.
    pub fn stop(mut self) -> io::Result<Statistics> {
        let Some(Ended { statistics, lost }) = self.end()? else { return Ok(Statistics::default()) };
        match lost.into_iter().next() {
            Some(ChangesLost { path, source }) => {
                let words = format!("{}: the last changes are lost: {source}", path.display());
                Err(io::Error::new(source.kind(), words))
            }
            None => Ok(statistics),
        }
    }

    /// None: it has ended before.
    fn end(&mut self) -> io::Result<Option<Ended>> {
        self.handle.stop();
        let Some(units) = self.units.take() else { return Ok(None) };
        let ended = units.join();
        ended.unwrap_or_else(|_| Err(io::Error::other("the thread of the units panicked"))).map(Some)
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        if let Err(error) = self.end() {
            tracing::warn!("the link of the units was lost: {error}");
        }
    }
}
