//! ectwin, the EtherCAT twin: virtual slave units for tests of EtherCAT masters.
