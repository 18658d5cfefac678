//! Stamps: numbers that tell what has to be made anew.
//!
//! An input carries a stamp that grows whenever it becomes another one. Whatever is made from inputs remembers their
//! stamps, and is stale once they differ.

/// A number that grows when an input becomes another one; 0 for what it was at first.
pub(crate) type Stamp = u64;

/// An input with its stamp.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stamped<T> {
    value: T,
    stamp: Stamp,
}

impl<T: PartialEq> Stamped<T> {
    /// With the first value, of stamp 0.
    pub(crate) fn new(value: T) -> Self {
        Self { value, stamp: 0 }
    }

    /// Takes over a value. The stamp grows if the value differs.
    pub(crate) fn set(&mut self, value: T) {
        if self.value != value {
            self.value = value;
            self.stamp += 1;
        }
    }

    /// The value as last set.
    pub(crate) fn get(&self) -> &T {
        &self.value
    }

    /// The stamp of the value: larger after each change.
    pub(crate) fn stamp(&self) -> Stamp {
        self.stamp
    }
}

/// The stamps of the inputs that something was made from.
#[derive(Debug)]
pub(crate) struct MadeFrom<const N: usize>([Stamp; N]);

impl<const N: usize> Default for MadeFrom<N> {
    /// Made from the first values of all inputs.
    fn default() -> Self {
        Self([0; N])
    }
}

impl<const N: usize> MadeFrom<N> {
    /// True if the stamps differ from those of the last call: then it has to be made anew.
    pub(crate) fn is_stale(&mut self, stamps: [Stamp; N]) -> bool {
        std::mem::replace(&mut self.0, stamps) != stamps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_made_is_stale_once_after_a_change() {
        let (mut a, mut b) = (Stamped::new(1), Stamped::new("x"));
        let mut made = MadeFrom::default();
        assert!(!made.is_stale([a.stamp(), b.stamp()]), "as at first");
        a.set(1);
        b.set("x");
        assert!(!made.is_stale([a.stamp(), b.stamp()]), "set to the same");
        b.set("y");
        assert!(made.is_stale([a.stamp(), b.stamp()]), "one changed");
        assert!(!made.is_stale([a.stamp(), b.stamp()]), "made anew");
        a.set(2);
        a.set(1);
        assert!(made.is_stale([a.stamp(), b.stamp()]), "changed and back");
        assert_eq!((*a.get(), *b.get()), (1, "y"));
    }
}
