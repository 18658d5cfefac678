//! Lists that grow with a clay.

use std::ops::{Deref, DerefMut};

/// Room for what is added, as a part of a list: one that doubles takes twice what it needs.
const ROOM: usize = 8;

/// A list that grows by an eighth of its length. A copy has room to grow already: a stroke that begins with a copy of a
/// clay would else copy all of it once more.
#[derive(Debug)]
pub(super) struct Roomy<T>(Vec<T>);

impl<T> Default for Roomy<T> {
    /// Nothing yet.
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T: Clone> Roomy<T> {
    /// Fills the list up to a length.
    pub(super) fn lengthen(&mut self, len: usize, item: T) {
        if len > self.0.capacity() {
            self.0.reserve_exact(len + len / ROOM - self.0.len());
        }
        self.0.resize(len, item);
    }

    /// Bytes that it has taken, room that it does not use yet counted.
    pub(super) fn taken(&self) -> usize {
        self.0.capacity() * size_of::<T>()
    }
}

impl<T: Clone> Clone for Roomy<T> {
    fn clone(&self) -> Self {
        let mut copy = Vec::with_capacity(self.0.len() + self.0.len() / ROOM);
        copy.extend_from_slice(&self.0);
        Self(copy)
    }
}

impl<T> From<Vec<T>> for Roomy<T> {
    fn from(list: Vec<T>) -> Self {
        Self(list)
    }
}

impl<T> Deref for Roomy<T> {
    type Target = Vec<T>;

    fn deref(&self) -> &Vec<T> {
        &self.0
    }
}

impl<T> DerefMut for Roomy<T> {
    fn deref_mut(&mut self) -> &mut Vec<T> {
        &mut self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_have_room_and_growth_takes_an_eighth_more() {
        let mut list = Roomy::from(vec![7_u32; 800]);
        list.shrink_to_fit();
        assert_eq!(list.taken(), 3200);
        list.lengthen(808, 1);
        assert_eq!((list.len(), list.taken(), list[807]), (808, 3636, 1));
        let mut copy = list.clone();
        assert_eq!(*copy, *list);
        let room = copy.taken();
        copy.lengthen(900, 2);
        assert_eq!((copy.taken(), copy[899]), (room, 2), "it was there");
    }
}
