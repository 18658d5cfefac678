//! Earlier states of a clay: the newest whole, those before as differences.

use bytemuck::NoUninit;

use super::mesh::Vertex;
use super::roomy::Roomy;
use super::shaping::Shaping;

/// What makes a list of another one.
#[derive(Debug)]
struct Difference<T> {
    len: usize,
    /// The entries that are others, with their places.
    others: Vec<(u32, T)>,
}

impl<T: NoUninit> Difference<T> {
    /// What makes `to` of `from`. Entries are the same if their bits are.
    fn between(from: &[T], to: &[T]) -> Self {
        let is_other = |(i, item): &(u32, &T)| {
            let known = from.get(*i as usize);
            known.is_none_or(|known| bytemuck::bytes_of(known) != bytemuck::bytes_of(*item))
        };
        let others = (0..).zip(to).filter(is_other);
        let mut others: Vec<(u32, T)> = others.map(|(i, item)| (i, *item)).collect();
        others.shrink_to_fit();
        Self {
            len: to.len(),
            others,
        }
    }

    fn apply(self, list: &mut Roomy<T>) {
        list.truncate(self.len);
        for (i, item) in self.others {
            match list.get_mut(i as usize) {
                Some(there) => *there = item,
                // Places beyond the end come in their order.
                None => list.lengthen(i as usize + 1, item),
            }
        }
    }

    fn bytes(&self) -> usize {
        self.others.len() * size_of::<(u32, T)>()
    }
}

/// What makes an earlier clay of a later one.
#[derive(Debug)]
struct Earlier {
    /// The earlier one but for its lists.
    rest: Shaping,
    vertices: Difference<Vertex>,
    leaving: Difference<u32>,
    triangles: Difference<[u32; 3]>,
    twins: Difference<[u32; 3]>,
    free_vertices: Difference<u32>,
    free_triangles: Difference<u32>,
    after: Difference<Vertex>,
    moved_in: Difference<u32>,
    turned_in: Difference<u32>,
    touched: Difference<bool>,
}

impl Earlier {
    fn of(later: &Shaping, earlier: &Shaping) -> Self {
        let [from, to] = [&later.mesh, &earlier.mesh];
        Self {
            rest: earlier.without_lists(),
            vertices: Difference::between(&from.vertices, &to.vertices),
            leaving: Difference::between(&from.leaving, &to.leaving),
            triangles: Difference::between(&from.triangles, &to.triangles),
            twins: Difference::between(&from.twins, &to.twins),
            free_vertices: Difference::between(&from.free_vertices, &to.free_vertices),
            free_triangles: Difference::between(&from.free_triangles, &to.free_triangles),
            after: Difference::between(&later.after, &earlier.after),
            moved_in: Difference::between(&later.moved_in, &earlier.moved_in),
            turned_in: Difference::between(&later.turned_in, &earlier.turned_in),
            touched: Difference::between(&later.touched, &earlier.touched),
        }
    }

    fn made_of(self, later: Shaping) -> Shaping {
        let mut mesh = later.mesh;
        self.vertices.apply(&mut mesh.vertices);
        self.leaving.apply(&mut mesh.leaving);
        self.triangles.apply(&mut mesh.triangles);
        self.twins.apply(&mut mesh.twins);
        self.free_vertices.apply(&mut mesh.free_vertices);
        self.free_triangles.apply(&mut mesh.free_triangles);
        let mut made = self.rest;
        made.mesh = mesh;
        (made.after, made.touched) = (later.after, later.touched);
        (made.moved_in, made.turned_in) = (later.moved_in, later.turned_in);
        self.after.apply(&mut made.after);
        self.moved_in.apply(&mut made.moved_in);
        self.turned_in.apply(&mut made.turned_in);
        self.touched.apply(&mut made.touched);
        made
    }

    fn bytes(&self) -> usize {
        let mesh = self.vertices.bytes()
            + self.leaving.bytes()
            + self.triangles.bytes()
            + self.twins.bytes()
            + self.free_vertices.bytes()
            + self.free_triangles.bytes();
        let stamps = self.moved_in.bytes() + self.turned_in.bytes() + self.touched.bytes();
        mesh + self.after.bytes() + stamps
    }
}

/// A clay as it stood after some of its strokes, one state behind the other. What comes back has every bit that it had.
#[derive(Debug, Default)]
pub struct States {
    newest: Option<Shaping>,
    /// What makes each state of the one after it, the earliest first.
    before: Vec<Earlier>,
}

impl States {
    /// Keeps a clay as it stands, which has more strokes than those that are kept.
    pub fn push(&mut self, shaping: &Shaping) {
        if let Some(earlier) = self.newest.replace(shaping.clone()) {
            self.before.push(Earlier::of(shaping, &earlier));
        }
    }

    /// The state of the most strokes.
    pub fn newest(&self) -> Option<&Shaping> {
        self.newest.as_ref()
    }

    /// Drops the newest state; the one before takes its place.
    pub fn pop(&mut self) {
        let later = self.newest.take();
        let both = self.before.pop().zip(later);
        self.newest = both.map(|(earlier, later)| earlier.made_of(later));
    }

    /// Drops the earliest states, so that what makes the others of the newest one takes no more than so many bytes.
    pub fn keep_to(&mut self, bytes: usize) {
        let (mut left, mut gone) = (self.bytes_of_differences(), 0);
        while left > bytes {
            left -= self.before[gone].bytes();
            gone += 1;
        }
        self.before.drain(..gone);
    }

    /// Bytes of what makes the earlier states of the newest one.
    pub fn bytes_of_differences(&self) -> usize {
        self.before.iter().map(Earlier::bytes).sum()
    }

    /// Bytes that all states take together.
    pub fn bytes(&self) -> usize {
        self.newest.as_ref().map_or(0, Shaping::bytes) + self.bytes_of_differences()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Document, SubjectRef};

    #[test]
    fn states_come_back_to_the_bit_and_take_little() {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.03, "tools": [{ "radius": 0.06, "coat": 0.05 }],
            "strokes": [{ "path": [0, 0, 480, 0, 0, 100] }, { "path": [480, 0, 0, 60, 0, 0] },
            { "path": [0, 0, 500, 0, 0, -100] }] } } }"#;
        let document = Document::from_json(text).expect("a document");
        let SubjectRef::Clay(clay) = &document.illustration().subject else {
            panic!("a clay")
        };
        let mut shaping = Shaping::new(clay).expect("a ball");
        let (mut states, mut seen) = (States::default(), Vec::new());
        for _ in 0..3 {
            states.push(&shaping);
            seen.push(format!("{shaping:?}"));
            shaping.stroke(clay, &mut |_| true).expect("a stroke");
        }
        let last = format!("{shaping:?}");
        let whole = states.newest().expect("the last").bytes();
        let (differences, all) = (states.bytes_of_differences(), states.bytes());
        assert_eq!(all, whole + differences);
        assert!(
            0 < differences && 4 * differences < whole,
            "{differences} beside {whole}"
        );
        while let (Some(state), Some(seen)) = (states.newest(), seen.pop()) {
            assert!(format!("{state:?}") == seen, "after {}", state.done());
            // It goes on as if it had never been put away.
            let mut again = state.clone();
            while again.done() < 3 {
                again.stroke(clay, &mut |_| true).expect("a stroke");
            }
            assert!(format!("{again:?}") == last);
            states.pop();
        }
        assert!(seen.is_empty() && states.newest().is_none());
    }

    #[test]
    fn the_earliest_go_first() {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.1, "strokes": [
            { "path": [0, 0, 480, 0, 0, 100] }, { "path": [480, 0, 0, 60, 0, 0] }] } } }"#;
        let document = Document::from_json(text).expect("a document");
        let SubjectRef::Clay(clay) = &document.illustration().subject else {
            panic!("a clay")
        };
        let mut shaping = Shaping::new(clay).expect("a ball");
        let mut states = States::default();
        for _ in 0..2 {
            states.push(&shaping);
            shaping.stroke(clay, &mut |_| true).expect("a stroke");
        }
        states.push(&shaping);
        states.keep_to(states.bytes_of_differences());
        assert_eq!(states.before.len(), 2);
        states.keep_to(states.bytes_of_differences() - 1);
        assert_eq!(states.before.len(), 1);
        states.keep_to(0);
        assert_eq!(states.newest().map(Shaping::done), Some(2));
        assert_eq!(states.bytes_of_differences(), 0);
    }

    #[test]
    fn entries_are_told_by_their_bits() {
        let changed = |from: &[f32], to: &[f32]| {
            let difference = Difference::between(from, to);
            let others = difference.others.len();
            let mut list = Roomy::from(from.to_vec());
            difference.apply(&mut list);
            let bits = |list: &[f32]| list.iter().map(|item| item.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&list), bits(to));
            others
        };
        assert_eq!(changed(&[0.0, 1.0, 2.0], &[-0.0, 1.0, 2.0]), 1);
        assert_eq!(changed(&[0.0, 1.0, 2.0], &[0.0, 1.0]), 0);
        assert_eq!(changed(&[0.0, 1.0], &[0.0, 1.0, 2.0, 3.0]), 2);
        assert_eq!(changed(&[], &[f32::NAN]), 1);
        assert_eq!(changed(&[f32::NAN], &[f32::NAN]), 0);
    }
}
