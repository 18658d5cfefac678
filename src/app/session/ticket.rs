//! The name of a load.

/// Names one load, so that what still arrives from an earlier load is dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Ticket(pub u64);
