//! The line: it executes steps, and after each the rules are checked.

use allocation_counter::measure;
use device::{DataDirection, DeviceConfig, FrameFate, Network, OutputsBeforeOp, ProcessDataConfig, Start};
use time::{Duration, Instant};
use wire::{AlState, Command, FrameKind, Returned, returned_datagrams};

use super::frame_rules::{self, End};
use super::images::Images;
use super::line_rules::Before;
use super::step::{Datagram, Model, Step, frame};
use super::units::{Units, unit};
use super::watched::length_bytes;
use super::{end_state, line_rules};
use crate::examine::without_panic;

/// Maximum number of units of a line, and maximum time of an input.
const UNITS_MAX: usize = 6;
const TIME_MAX: Duration = Duration::from_secs(3);
/// How long a master waits for a state.
const PATIENCE: Duration = Duration::from_millis(200);

/// A line of units at one point in time.
pub(super) struct Line {
    network: Units,
    configs: Vec<DeviceConfig>,
    now: Instant,
    images: Images,
    highest: AlState,
}

type Rules = Result<(), String>;

impl Line {
    /// A line of these units.
    pub(super) fn of(models: &[Model]) -> Self {
        let units = models.iter().take(UNITS_MAX).enumerate().map(|(number, model)| unit(*model, number));
        let (configs, units): (Vec<_>, Vec<_>) = units.unzip();
        let now = Instant::ZERO;
        let network = Network::power_on(configs.iter().cloned().zip(units), now);
        let images = Images::of(&configs, &network);
        let mut line = Self { network, configs, now, images, highest: AlState::Init };
        line.network.poll(now);
        line
    }

    /// Executes a step.
    pub(super) fn step(&mut self, step: &Step) -> Rules {
        match step {
            // A second line is ignored.
            Step::Line(_) => Ok(()),
            Step::Bring(unit, state) => self.bring(*unit, *state),
            Step::Cycle(byte) => (0..self.network.len()).try_for_each(|unit| self.cycle(unit, *byte)),
            Step::Frame(datagrams) => self.any_frame(frame(datagrams), End::Master, Network::frame),
            Step::Raw(bytes) => self.any_frame(bytes.clone(), End::Master, Network::frame),
            Step::Far(datagrams) => self.any_frame(frame(datagrams), End::Far, |network, now, frame| {
                network.frame_at_far_end(now, frame)
            }),
            Step::Corrupt(unit, datagrams) => {
                let position = *unit;
                self.any_frame(frame(datagrams), End::Master, move |network, now, frame| {
                    network.corrupted_frame(now, frame, position)
                })
            }
            Step::Wait(micros) => self.wait(Duration::from_micros(*micros)),
            Step::Cable(cable, plugged) => {
                self.network.set_cable(*cable, *plugged);
                self.poll()
            }
            Step::Power(unit, on) => {
                self.images.forget(*unit);
                if *on {
                    self.network.restart(*unit, self.now, Start::PowerOn);
                } else {
                    self.network.power_off(*unit, self.now);
                }
                self.poll()
            }
        }
    }

    /// The conditions at the end of an input.
    pub(super) fn end(&mut self) -> Rules {
        (0..self.network.len()).try_for_each(|position| {
            let Some((_, esc)) = self.network.slave_mut(position) else { return Ok(()) };
            end_state::check(esc, self.now).map_err(|reason| format!("at the end, unit {position}: {reason}"))
        })
    }

    /// The highest state that a unit has been in.
    pub(super) const fn outcome(&self) -> &'static str {
        match self.highest {
            AlState::Op => "op",
            AlState::SafeOp => "safe-op",
            AlState::PreOp => "pre-op",
            _ => "init",
        }
    }

    /// A frame of the input, which may be any bytes.
    fn any_frame(
        &mut self,
        frame: Vec<u8>,
        end: End,
        send: impl FnOnce(&mut Units, Instant, &mut [u8]) -> FrameFate,
    ) -> Rules {
        let returned = self.send(frame.clone(), end, send)?;
        self.images.master_sent(&returned_datagrams(&frame));
        self.images.check_inputs(&returned_datagrams(&frame), &returned, &self.network)?;
        self.poll()
    }

    /// Sends a frame and checks its fate.
    fn send(
        &mut self,
        mut frame: Vec<u8>,
        end: End,
        send: impl FnOnce(&mut Units, Instant, &mut [u8]) -> FrameFate,
    ) -> Result<Vec<Returned>, String> {
        let sent = frame.clone();
        let is_defective = matches!(FrameKind::of(&sent), FrameKind::Defective(_));
        let before = is_defective.then(|| end_state::snapshot(&self.network, self.now));
        let (network, now) = (&mut self.network, self.now);
        let mut fate = Ok(FrameFate::Destroyed);
        let allocated = measure(|| fate = without_panic(|| Ok(send(network, now, &mut frame))));
        let fate = fate?;
        if allocated.count_total > 0 {
            return Err(format!("a frame allocates {} times", allocated.count_total));
        }
        frame_rules::check(&sent, &frame, end, fate, self.network.len())?;
        if let Some(before) = before {
            end_state::unchanged(&before, &end_state::snapshot(&self.network, self.now))?;
        }
        Ok(returned_datagrams(&frame))
    }

    fn exchange(&mut self, datagrams: &[Datagram]) -> Result<Vec<Returned>, String> {
        let returned = self.send(frame(datagrams), End::Master, Network::frame)?;
        self.poll()?;
        Ok(returned)
    }

    /// Lets the units react, and checks the line.
    fn poll(&mut self) -> Rules {
        let before = Before::of(&self.network);
        self.network.poll(self.now);
        line_rules::check(&mut self.network, &self.configs, &before, self.now)?;
        self.images.check_outputs(&mut self.network)?;
        let states = (0..self.network.len()).filter_map(|position| self.network.device(position));
        let rank = |state: &AlState| state.bits();
        if let Some(highest) = states.map(|device| device.al_status().state).max_by_key(rank) {
            self.highest = if rank(&highest) > rank(&self.highest) { highest } else { self.highest };
        }
        Ok(())
    }

    fn wait(&mut self, duration: Duration) -> Rules {
        let end = (self.now + duration).min(Instant::ZERO + TIME_MAX).max(self.now);
        while self.network.deadline() <= end {
            self.now = self.network.deadline().max(self.now);
            self.poll()?;
        }
        self.now = end;
        Ok(())
    }

    /// A master takes a unit to a state, step by step, and gives up if a state is not reached.
    fn bring(&mut self, unit: usize, state: AlState) -> Rules {
        let Some(config) = self.configs.get(unit).cloned() else { return Ok(()) };
        self.images.forget(unit);
        self.write(unit, 0x0010, &(0x1001 + unit as u16).to_le_bytes())?;
        // Acknowledges an error, whatever it is.
        self.request(unit, AlState::Init, true)?;
        if state == AlState::Init || !self.comes_to(unit, AlState::Init)? {
            return Ok(());
        }
        self.write(unit, 0x0600, &[0; 256])?;
        self.write(unit, 0x0800, &[0; 128])?;
        if let Some(mailbox) = config.mailbox {
            let (receive, send) = (mailbox.standard.receive, mailbox.standard.send);
            self.write(unit, 0x0800, &sync_manager(receive.start, receive.length_bytes, 0x26))?;
            self.write(unit, 0x0808, &sync_manager(send.start, send.length_bytes, 0x22))?;
        }
        self.request(unit, AlState::PreOp, false)?;
        if state == AlState::PreOp || !self.comes_to(unit, AlState::PreOp)? {
            return Ok(());
        }
        for (number, described) in (0..).zip(&config.process_data) {
            let length_bytes = self.length_bytes(unit, described);
            let (control, logical, kind) = match described.direction {
                DataDirection::Outputs => (0x64, outputs_address(unit), 2),
                DataDirection::Inputs => (0x20, inputs_address(unit), 1),
            };
            let at = 0x0800 + 8 * u16::from(described.sync_manager.0);
            self.write(unit, at, &sync_manager(described.start, length_bytes, control))?;
            self.write(unit, 0x0600 + 16 * number, &fmmu(logical, length_bytes, described.start, kind))?;
        }
        self.request(unit, AlState::SafeOp, false)?;
        if !self.comes_to(unit, AlState::SafeOp)? {
            return Ok(());
        }
        self.images.is_set_up(unit);
        if state == AlState::Op {
            self.request(unit, AlState::Op, false)?;
            // The first outputs take it to OP.
            self.cycle(unit, 0)?;
            if config.outputs_before_op == OutputsBeforeOp::NotRequired {
                self.comes_to(unit, AlState::Op)?;
            }
        }
        Ok(())
    }

    fn comes_to(&mut self, unit: usize, state: AlState) -> Result<bool, String> {
        let end = self.now + PATIENCE;
        while self.now < end {
            let Some(device) = self.network.device(unit) else { return Ok(false) };
            let status = device.al_status();
            if status.state == state && !status.error {
                return Ok(true);
            }
            if status.error || device.is_off() {
                return Ok(false);
            }
            self.wait(Duration::from_millis(1))?;
            if self.now >= Instant::ZERO + TIME_MAX {
                return Ok(false);
            }
        }
        Ok(false)
    }

    /// The present length of a SyncManager's data.
    fn length_bytes(&self, unit: usize, described: &ProcessDataConfig) -> u16 {
        let device = self.network.device(unit);
        device.map_or(0, |device| length_bytes(&**device.unit(), described))
    }

    fn request(&mut self, unit: usize, state: AlState, acknowledge: bool) -> Rules {
        let control = state.bits() | u16::from(acknowledge) << 4;
        self.write(unit, 0x0120, &control.to_le_bytes())
    }

    fn write(&mut self, unit: usize, offset: u16, data: &[u8]) -> Rules {
        let position = (unit as u16).wrapping_neg();
        self.exchange(&[Datagram::new(Command::Apwr, position, offset, data.to_vec())]).map(|_| ())
    }

    /// Sends complete outputs with equal bytes to a unit, and reads its inputs.
    fn cycle(&mut self, unit: usize, byte: u8) -> Rules {
        let Some(config) = self.configs.get(unit) else { return Ok(()) };
        let [outputs, inputs] = [DataDirection::Outputs, DataDirection::Inputs].map(|direction| {
            let described = config.process_data.iter().filter(|described| described.direction == direction);
            described.map(|described| usize::from(self.length_bytes(unit, described))).sum()
        });
        let sent = frame(&[
            Datagram::logical(Command::Lwr, outputs_address(unit), vec![byte; outputs]),
            Datagram::logical(Command::Lrd, inputs_address(unit), vec![0; inputs]),
        ]);
        let returned = self.send(sent, End::Master, Network::frame)?;
        self.images.cycle_came_back(unit, byte, &returned, &self.network)?;
        self.poll()
    }
}

/// Logical addresses of the outputs and of the inputs of a unit.
const fn outputs_address(unit: usize) -> u32 {
    0x0001_0000 * (unit as u32 + 1)
}

const fn inputs_address(unit: usize) -> u32 {
    outputs_address(unit) + 0x1000
}

/// Settings of an enabled SyncManager; one without length is left disabled.
fn sync_manager(start: u16, length_bytes: u16, control: u8) -> [u8; 8] {
    let ([s0, s1], [l0, l1]) = (start.to_le_bytes(), length_bytes.to_le_bytes());
    [s0, s1, l0, l1, control, 0, u8::from(length_bytes > 0), 0]
}

/// Settings of an FMMU that maps whole bytes; `kind` is 1 for reading and 2 for writing.
fn fmmu(logical_start: u32, length_bytes: u16, physical_start: u16, kind: u8) -> [u8; 16] {
    let mut settings = [0; 16];
    settings[..4].copy_from_slice(&logical_start.to_le_bytes());
    settings[4..6].copy_from_slice(&length_bytes.to_le_bytes());
    settings[7] = 7;
    settings[8..10].copy_from_slice(&physical_start.to_le_bytes());
    settings[11] = kind;
    settings[12] = u8::from(length_bytes > 0);
    settings
}
