//! `ectwin run FILE… --link LINK`.

use std::fs::File;
use std::net::{SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ectwin::{ModbusServer, Setup, Twin};
use link::{Clock, Observer, Recorder, Statistics};
use signal_hook::consts::{SIGINT, SIGTERM};

use crate::cli::RunArgs;
use crate::failure::Failure;
use crate::{output, unit_files};

/// Emulates the units until SIGINT, SIGTERM or the end of the link.
pub(crate) fn run(args: &RunArgs) -> Result<(), Failure> {
    let setups = setups(args)?;
    let units = setups.len();
    let mut port = link::open(&args.link).map_err(Failure::Link)?;
    let listener = args.modbus.map(listen).transpose()?;
    #[cfg(feature = "opcua")]
    let opcua_listener = args.opcua.map(opcua::listen).transpose()?;
    let clock = Clock::start();
    let mut recorder = recorder(args, &clock)?;
    let stop = stop_on_signals().map_err(Failure::LinkLost)?;

    let with_system_time = |setup: Setup| setup.system_time_ns(clock.origin_unix_nanos());
    let mut twin = Twin::power_on(setups.into_iter().map(with_system_time));
    let _modbus = listener.map(|listener| serve_modbus(&mut twin, listener)).transpose()?;
    #[cfg(feature = "opcua")]
    let _opcua = opcua_listener.map(|listener| opcua::serve(&mut twin, listener)).transpose()?;
    // The port is open: a frame that comes from now on waits in it and is answered.
    output::print_line(format_args!("ready link={} units={units}", args.link))?;
    let observer = recorder.as_mut().map(|recorder| recorder as &mut dyn Observer);
    let statistics = ectwin::run(twin, &mut port, observer, &clock, &stop);

    let recorded = recorder.map_or(Ok(()), |recorder| finish(recorder, args));
    tell(statistics.map_err(Failure::LinkLost)?);
    recorded
}

fn setups(args: &RunArgs) -> Result<Vec<Setup>, Failure> {
    let read = |path: &std::path::PathBuf| {
        let setup = unit_files::read(path, args.program.as_deref())?;
        Ok(if args.fast { setup.fast() } else { setup })
    };
    args.units.iter().map(read).collect()
}

fn listen(address: SocketAddr) -> Result<TcpListener, Failure> {
    TcpListener::bind(address).map_err(|source| Failure::Modbus { address, source })
}

fn serve_modbus(twin: &mut Twin, listener: TcpListener) -> Result<ModbusServer, Failure> {
    let server = twin.serve_modbus(listener).map_err(Failure::LinkLost)?;
    tracing::info!("Modbus TCP is served at {}", server.address());
    Ok(server)
}

#[cfg(feature = "opcua")]
mod opcua {
    use ectwin::OpcUaServer;

    use super::{Failure, SocketAddr, TcpListener, Twin};

    pub(super) fn listen(address: SocketAddr) -> Result<TcpListener, Failure> {
        TcpListener::bind(address).map_err(|source| Failure::OpcUa { address, source })
    }

    pub(super) fn serve(twin: &mut Twin, listener: TcpListener) -> Result<OpcUaServer, Failure> {
        let server = twin.serve_opcua(listener).map_err(Failure::LinkLost)?;
        tracing::info!("OPC UA is served at opc.tcp://{}", server.address());
        Ok(server)
    }
}

fn recorder(args: &RunArgs, clock: &Clock) -> Result<Option<Recorder>, Failure> {
    let Some(path) = &args.pcap else { return Ok(None) };
    let recorder = File::create(path).and_then(|file| Recorder::start(file, &args.link.to_string(), clock));
    recorder.map(Some).map_err(|source| Failure::Unwritable { path: path.clone(), source })
}

/// A flag that SIGINT and SIGTERM set.
fn stop_on_signals() -> std::io::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        signal_hook::flag::register(signal, Arc::clone(&stop))?;
    }
    Ok(stop)
}

fn finish(recorder: Recorder, args: &RunArgs) -> Result<(), Failure> {
    let path = args.pcap.clone().unwrap_or_default();
    let recording = recorder.finish().map_err(|source| Failure::Unwritable { path, source })?;
    if recording.lost > 0 {
        tracing::warn!("the capture has {} frames and lacks {}", recording.written, recording.lost);
    }
    Ok(())
}

fn tell(statistics: Statistics) {
    let Statistics { frames, destroyed, unsent, late_polls } = statistics;
    tracing::info!(frames, destroyed, unsent, late_polls, "stopped");
}
