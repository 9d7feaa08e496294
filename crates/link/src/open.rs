//! Opening a link.

use crate::raw::RawPort;
use crate::tap::TapPort;
use crate::udp::UdpPort;
use crate::{FramePort, LinkSpec, OpenError};

/// Opens a link.
///
/// # Errors
/// Why it cannot be opened; [`OpenError::help`] describes the remedy.
pub fn open(link: &LinkSpec) -> Result<Box<dyn FramePort>, OpenError> {
    Ok(match link {
        LinkSpec::Raw(name) => Box::new(RawPort::open(name)?),
        LinkSpec::Udp(address) => Box::new(UdpPort::open(*address)?),
        LinkSpec::Tap(name) => Box::new(TapPort::open(name)?),
    })
}
