//! A CPU Unit that runs continuously on a thread, a server at a free port, and clients.

use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};

use modbus::{ModbusMap, Server};
use nx_bus::{UnitEnd, UnitHeader};
use nx_ect101::{DataSetKind, Direction, IoAllocation};
use plc::{CpuSettings, CpuUnit, DeviceVariables, Program, outside};
use time::Instant;
use tokio_modbus::Slave;
use tokio_modbus::client::{Context, tcp};

/// Six entries UINTs, one BYTES, two UDINT in each direction.
pub(crate) struct Bench {
    server: Option<Server>,
    unit: Mutex<UnitEnd>,
    m_to_c_bytes: usize,
    shared: Arc<Shared>,
    cpu_thread: Option<JoinHandle<()>>,
}

struct Shared {
    cpu: Mutex<Option<CpuUnit>>,
    stands: AtomicBool,
    cycles: AtomicU64,
    ends: AtomicBool,
}

impl Bench {
    pub(crate) fn with(user_program: impl Program + Send + 'static) -> Self {
        let mut allocation = IoAllocation::factory();
        for direction in Direction::ALL {
            allocation.select(direction, DataSetKind::Bytes, 1);
            allocation.select(direction, DataSetKind::Udint, 2);
        }
        let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &allocation));
        let (unit, bus) = nx_bus::connect(variables.unit().m_to_c_bytes, variables.unit().c_to_m_bytes);
        let mut cpu =
            CpuUnit::power_on(Instant::ZERO, CpuSettings::default(), variables, bus, Box::new(user_program));
        let (program, end) = outside::connect(cpu.io().variables());
        cpu.attach(Box::new(program));
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let map = ModbusMap::of(cpu.io().variables());
        let server = Some(modbus::serve(listener, [(map, end)]).unwrap());
        let shared = Arc::new(Shared {
            cpu: Mutex::new(Some(cpu)),
            stands: AtomicBool::new(false),
            cycles: AtomicU64::new(0),
            ends: AtomicBool::new(false),
        });
        let for_thread = Arc::clone(&shared);
        let cpu_thread = Some(thread::spawn(move || for_thread.run()));
        let m_to_c_bytes = allocation.layout(Direction::MToC).size_bytes();
        Self { server, unit: Mutex::new(unit), m_to_c_bytes, shared, cpu_thread }
    }

    /// Runs a test, and then ends everything.
    pub(crate) fn run(self, test: impl AsyncFnOnce(&Self)) {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        runtime.block_on(test(&self));
    }

    pub(crate) fn address(&self) -> SocketAddr {
        self.server.as_ref().unwrap().address()
    }

    pub(crate) async fn client(&self, unit_identifier: u8) -> Context {
        tcp::connect_slave(self.address(), Slave(unit_identifier)).await.unwrap()
    }

    /// The unit sends data M to C; they have arrived when this returns.
    pub(crate) fn send(&self, fill: impl FnOnce(&mut UnitHeader, &mut [u8])) {
        let (mut header, mut image) = (UnitHeader::default(), vec![0; self.m_to_c_bytes]);
        fill(&mut header, &mut image);
        self.unit.lock().unwrap().m_to_c.publish(header, &image);
        let before = self.shared.cycles.load(Ordering::Acquire);
        while self.shared.cycles.load(Ordering::Acquire) < before + 2 {
            thread::yield_now();
        }
    }

    /// Waits for this number of task periods.
    pub(crate) async fn cycles(&self, count: u64) {
        let before = self.shared.cycles.load(Ordering::Acquire);
        while self.shared.cycles.load(Ordering::Acquire) <= before + count {
            tokio::task::yield_now().await;
        }
    }

    /// The bytes of a variable as the unit receives them.
    pub(crate) async fn c_to_m(&self, name: &str) -> Vec<u8> {
        self.cycles(1).await;
        let cpu = self.shared.cpu.lock().unwrap();
        let io = cpu.as_ref().unwrap().io();
        io.read(io.find(name).unwrap()).unwrap().to_vec()
    }

    /// No more task periods.
    pub(crate) fn stop_cpu(&self) {
        self.shared.stands.store(true, Ordering::Release);
        drop(self.shared.cpu.lock().unwrap());
    }

    pub(crate) fn remove_cpu(&self) {
        self.shared.cpu.lock().unwrap().take();
    }
}

impl Shared {
    fn run(&self) {
        while !self.ends.load(Ordering::Acquire) {
            if let Some(cpu) = self.cpu.lock().unwrap().as_mut()
                && !self.stands.load(Ordering::Acquire)
            {
                cpu.cycle(cpu.deadline());
                self.cycles.fetch_add(1, Ordering::AcqRel);
            }
            thread::yield_now();
        }
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        drop(self.server.take());
        self.shared.ends.store(true, Ordering::Release);
        if let Some(thread) = self.cpu_thread.take() {
            thread.join().unwrap();
        }
    }
}
