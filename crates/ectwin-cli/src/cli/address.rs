//! Addresses at which clients are served; a port alone means 127.0.0.1.

use std::net::{Ipv4Addr, SocketAddr};
use std::num::ParseIntError;

/// The address for Modbus TCP.
pub(super) fn modbus(text: &str) -> Result<SocketAddr, String> {
    address(text, 1502)
}

/// The address for OPC UA.
pub(super) fn opcua(text: &str) -> Result<SocketAddr, String> {
    if !cfg!(feature = "opcua") {
        return Err(
            "this build does not support OPC UA; `cargo build --features opcua` builds one that does"
                .to_owned(),
        );
    }
    address(text, 4840)
}

fn address(text: &str, example: u16) -> Result<SocketAddr, String> {
    let on_loopback = |port| SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let address = text.parse().or_else(|_| text.parse().map(on_loopback));
    address.map_err(|_: ParseIntError| {
        format!(
            "{text:?} is not an address: expected PORT or ADDR:PORT, such as {example} or 127.0.0.1:{example}"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modbus_is_served_on_loopback_unless_the_address_says_otherwise() {
        let address = |text| modbus(text).map(|address| address.to_string());
        assert_eq!(address("1502").unwrap(), "127.0.0.1:1502");
        assert_eq!(address("0.0.0.0:502").unwrap(), "0.0.0.0:502");
        assert_eq!(address("[::1]:0").unwrap(), "[::1]:0");
        for wrong in ["", "65536", "127.0.0.1", "localhost:1502"] {
            assert!(address(wrong).is_err_and(|message| message.contains("127.0.0.1:1502")), "{wrong}");
        }
    }

    #[test]
    fn a_build_without_opc_ua_says_which_one_has_it() {
        let address = opcua("4840").map(|address| address.to_string());
        if cfg!(feature = "opcua") {
            assert_eq!(address.unwrap(), "127.0.0.1:4840");
        } else {
            assert!(address.is_err_and(|message| message.contains("--features opcua")));
        }
    }
}
