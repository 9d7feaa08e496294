//! The Explicit Device ID: ID switch, software setting, and the alias in ESC register 0x0012 (manual, 3-3 and
//! A-6-4, object 10E0).

use wire::SdoAbort;

/// The source of the unit's ID and its present value.
///
/// Switch and software setting are read only at power-on; object 10E0 changes the alias immediately.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Identification {
    switch: u8,
    at_power_on: u16,
    software: u16,
    station_alias: Option<u16>,
}

impl Identification {
    /// The ID at power-on: the switch, or the software setting while the switch is at 0x00.
    pub(crate) fn at_power_on(switch: u8, software: u16) -> Self {
        let id = if switch == 0 { software } else { u16::from(switch) };
        Self { switch, at_power_on: id, software, station_alias: (id != 0).then_some(id) }
    }

    /// The software setting.
    pub(crate) const fn software(self) -> u16 {
        self.software
    }

    /// A master has set the station alias in the SII. With the switch at 0x00 that is the software setting,
    /// effective from the next power-on or restart, because the register is loaded from the SII then.
    pub(crate) const fn take_alias_of_sii(&mut self, alias: u16) {
        if self.switch == 0 {
            self.software = alias;
        }
    }

    /// The Explicit Device ID; none if it is 0, which is outside the manual's setting ranges.
    pub(crate) fn explicit_device_id(self) -> Option<u16> {
        (self.at_power_on != 0).then_some(self.at_power_on)
    }

    /// The value for ESC register 0x0012; none if no ID has been set, so that the value loaded from the SII is kept.
    pub(crate) const fn station_alias(self) -> Option<u16> {
        self.station_alias
    }

    /// Reads 10E0:01, Configured Station Alias register value.
    pub(crate) fn alias_register_value(self) -> u16 {
        if self.switch == 0 { self.software } else { u16::from(self.switch) }
    }

    /// Reads 10E0:03, Reload ID-selector value.
    pub(crate) fn switch_value(self) -> u16 {
        u16::from(self.switch)
    }

    /// Writes 10E0:01: the software setting, unless the switch is used.
    pub(crate) fn set_software(&mut self, id: u16) -> Result<(), SdoAbort> {
        if self.switch != 0 {
            return Err(SdoAbort::LOCAL_CONTROL);
        }
        self.software = id;
        self.station_alias = Some(id);
        Ok(())
    }

    /// Writes 10E0:03: 0 reads the switch again, if it is used.
    pub(crate) fn reload_switch(&mut self, command: u16) -> Result<(), SdoAbort> {
        if self.switch == 0 || command != 0 {
            return Err(SdoAbort::LOCAL_CONTROL);
        }
        self.station_alias = Some(u16::from(self.switch));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_the_switch_at_0_software_sets_the_id() {
        let mut id = Identification::at_power_on(0x00, 300);
        assert_eq!((id.explicit_device_id(), id.station_alias()), (Some(300), Some(300)));
        assert_eq!(id.set_software(500), Ok(()));
        assert_eq!((id.alias_register_value(), id.station_alias()), (500, Some(500)));
        assert_eq!(id.explicit_device_id(), Some(300), "until the next power-on");
        assert_eq!(id.reload_switch(0), Err(SdoAbort::LOCAL_CONTROL));
        assert_eq!(id.switch_value(), 0);
    }

    #[test]
    fn with_the_switch_set_it_is_in_force() {
        let mut id = Identification::at_power_on(0x21, 300);
        assert_eq!((id.explicit_device_id(), id.station_alias()), (Some(0x21), Some(0x21)));
        assert_eq!(id.set_software(500), Err(SdoAbort::LOCAL_CONTROL));
        assert_eq!(id.reload_switch(1), Err(SdoAbort::LOCAL_CONTROL));
        assert_eq!(id.reload_switch(0), Ok(()));
        assert_eq!((id.alias_register_value(), id.switch_value()), (0x21, 0x21));
    }

    #[test]
    fn without_switch_and_software_setting_there_is_no_id() {
        let id = Identification::at_power_on(0, 0);
        assert_eq!((id.explicit_device_id(), id.station_alias()), (None, None));
    }
}
