//! One EtherCAT slave controller of the ET1100 class, with two faces: the wire and the PDI.
