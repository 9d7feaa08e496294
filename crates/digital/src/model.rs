//! The terminal as the crates above see it: without events, faults and switches. The controller itself drives RUN and the
//! indicators of the ports.

use core::fmt::Debug;

use coe_kit::indicators::{self, Pattern};
use unit_model::{DataValid, Model, ModelUnit, SlaveView};

use crate::terminal::Terminal;
use crate::wiring::Wiring;

/// The model.
pub static MODEL: DigitalModel = DigitalModel;

/// What of the model is the same for all terminals.
#[derive(Clone, Copy, Debug)]
pub struct DigitalModel;

const RUN: &str = "RUN";
const PORT_IN: &str = "L/A IN";
const PORT_OUT: &str = "L/A OUT";

impl Model for DigitalModel {
    fn name(&self) -> &'static str {
        "digital"
    }

    fn indicators(&self) -> &'static [&'static str] {
        &[RUN, PORT_IN, PORT_OUT]
    }
}

impl<W: Wiring + Debug + Send + 'static> ModelUnit for Terminal<W> {
    fn model(&self) -> &'static dyn Model {
        &MODEL
    }

    fn data_valid(&self) -> DataValid {
        self.data_valid
    }

    fn indicator(&self, name: &str, slave: &SlaveView) -> Option<Pattern> {
        match name {
            RUN => Some(indicators::run(slave.al_status.state)),
            PORT_IN => Some(slave.in_port.pattern()),
            PORT_OUT => Some(slave.out_port.pattern()),
            _ => None,
        }
    }
}
