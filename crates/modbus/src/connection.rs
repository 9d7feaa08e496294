//! One client: frames in, answers out, until it disconnects or violates the protocol.

use std::io;
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::time::timeout;

use crate::answer::answer;
use crate::unit::Unit;

/// Maximum time between two requests of a client.
const IDLE: Duration = Duration::from_secs(300);
/// Maximum time from the first byte of a frame to its last, and for a client to receive an answer.
const FRAME: Duration = Duration::from_secs(3);

/// MBAP header: transaction identifier, protocol identifier, length, unit identifier.
const HEADER_BYTES: usize = 7;
/// Range of the length field: unit identifier and function code at least, and a PDU of 253 bytes at most.
const LENGTHS: core::ops::RangeInclusive<u16> = 2..=254;

/// The frame of a request.
struct Frame {
    transaction_identifier: [u8; 2],
    unit_identifier: u8,
    function: u8,
    octets: Vec<u8>,
}

/// Answers one client until it closes the connection. Calls `requested` for each request that is a Modbus
/// frame, whatever its function is.
///
/// # Errors
/// The client sent something that is not a Modbus frame, it was silent for too long, did not receive its
/// answers, or the connection broke.
pub(crate) async fn serve(
    mut stream: impl AsyncRead + AsyncWrite + Unpin,
    units: &[Unit],
    mut requested: impl FnMut(),
) -> io::Result<()> {
    while let Some(frame) = next_frame(&mut stream).await? {
        requested();
        let response = answer(units, frame.unit_identifier, frame.function, &frame.octets).await;
        let packed = pack(&frame, &response);
        timeout(FRAME, stream.write_all(&packed)).await??;
    }
    Ok(())
}

/// None: the client has closed the connection between two frames.
async fn next_frame(stream: &mut (impl AsyncRead + Unpin)) -> io::Result<Option<Frame>> {
    let mut header = [0; HEADER_BYTES];
    if timeout(IDLE, stream.read(&mut header[..1])).await?? == 0 {
        return Ok(None);
    }
    timeout(FRAME, async {
        stream.read_exact(&mut header[1..]).await?;
        let [high, low, protocol_high, protocol_low, length_high, length_low, unit_identifier] = header;
        let length = u16::from_be_bytes([length_high, length_low]);
        if [protocol_high, protocol_low] != [0, 0] || !LENGTHS.contains(&length) {
            // The start of the next frame is unknown.
            return Err(io::Error::new(io::ErrorKind::InvalidData, "no Modbus frame"));
        }
        let mut octets = vec![0; usize::from(length) - 1];
        stream.read_exact(&mut octets).await?;
        let function = octets.remove(0);
        Ok(Some(Frame { transaction_identifier: [high, low], unit_identifier, function, octets }))
    })
    .await?
}

fn pack(frame: &Frame, response: &[u8]) -> Vec<u8> {
    // A response has 253 bytes at most.
    let length = (response.len() + 1) as u16;
    let mut packed = Vec::with_capacity(HEADER_BYTES + response.len());
    packed.extend(frame.transaction_identifier);
    packed.extend([0, 0]);
    packed.extend(length.to_be_bytes());
    packed.push(frame.unit_identifier);
    packed.extend(response);
    packed
}
