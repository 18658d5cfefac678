//! Which pieces and hollows of voxels a clay has (spec/sweepers.md, B, “From a volume”).

use glam::{IVec3, USizeVec3};

/// What is known of a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// It is not meant.
    Free,
    /// It is meant, and no piece has it yet.
    Meant,
    /// It is of a piece that was counted.
    Counted,
    /// It is of the largest piece.
    Kept,
    /// It is reached from outside.
    Reached,
}

/// Fills the largest piece of the voxels that are meant and takes the others away. Voxels hang together by their faces,
/// and what is around them by edges too, as the surface between them has it. Of pieces of one size the first counts.
/// The outermost layer has to be free. Gives how many pieces are taken away.
pub(super) fn keep_largest(is_inside: &mut [bool], dims: USizeVec3) -> usize {
    let by_faces = neighbours(1);
    let state = |is_in: &bool| match is_in {
        true => State::Meant,
        false => State::Free,
    };
    let mut states: Vec<State> = is_inside.iter().map(state).collect();
    let (mut pieces, mut largest) = (0, (0, 0));
    for seed in 0..states.len() {
        if states[seed] == State::Meant {
            let is_next = |state| state == State::Meant;
            let size = flood(
                (&mut states, dims),
                seed,
                &by_faces,
                is_next,
                State::Counted,
            );
            pieces += 1;
            if size > largest.0 {
                largest = (size, seed);
            }
        }
    }
    if pieces == 0 {
        return 0;
    }
    let is_piece = |state| state == State::Counted;
    flood(
        (&mut states, dims),
        largest.1,
        &by_faces,
        is_piece,
        State::Kept,
    );
    let is_around = |state| state != State::Kept && state != State::Reached;
    flood(
        (&mut states, dims),
        0,
        &neighbours(2),
        is_around,
        State::Reached,
    );
    for (is_in, state) in is_inside.iter_mut().zip(states) {
        *is_in = state != State::Reached;
    }
    pieces - 1
}

/// Steps to the voxels that have a face in common, or by 2 an edge.
fn neighbours(most: i32) -> Vec<IVec3> {
    let steps = (0..27).map(|i| IVec3::new(i % 3, i / 3 % 3, i / 9) - 1);
    let is_near = |step: &IVec3| (1..=most).contains(&step.abs().element_sum());
    steps.filter(is_near).collect()
}

/// Gives a new state to a voxel and to all that is reached from it through states that `may` be gone through; that of
/// the new state may not. Gives how many those are.
fn flood(
    (states, dims): (&mut [State], USizeVec3),
    seed: usize,
    steps: &[IVec3],
    may: impl Fn(State) -> bool,
    to: State,
) -> usize {
    let size = dims.as_ivec3();
    let mut count = 1;
    let mut waiting = vec![seed];
    states[seed] = to;
    while let Some(index) = waiting.pop() {
        let layer = dims.x * dims.y;
        let at = USizeVec3::new(index % dims.x, index / dims.x % dims.y, index / layer).as_ivec3();
        for step in steps {
            let next = at + step;
            if next.cmplt(IVec3::ZERO).any() || next.cmpge(size).any() {
                continue;
            }
            let next = next.as_usizevec3();
            let next = next.x + dims.x * (next.y + dims.y * next.z);
            if may(states[next]) {
                states[next] = to;
                count += 1;
                waiting.push(next);
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of a layer, voxels that are meant as `#`, in the middle of three layers.
    fn kept(rows: &[&str]) -> (Vec<String>, usize) {
        let dims = USizeVec3::new(rows[0].len(), rows.len(), 3);
        let layer = dims.x * dims.y;
        let mut is_inside = vec![false; 3 * layer];
        for (y, row) in rows.iter().enumerate() {
            for (x, letter) in row.bytes().enumerate() {
                is_inside[layer + x + dims.x * y] = letter == b'#';
            }
        }
        let gone = keep_largest(&mut is_inside, dims);
        let lines = is_inside[layer..2 * layer].chunks(dims.x);
        let letter = |is_in: &bool| if *is_in { '#' } else { '.' };
        let lines = lines.map(|row| row.iter().map(letter).collect());
        (lines.collect(), gone)
    }

    #[test]
    fn of_pieces_the_largest_is_kept() {
        let (lines, gone) = kept(&[".......", ".##..#.", ".##..#.", "...#.#.", "......."]);
        assert_eq!(gone, 2, "by a corner nothing hangs together");
        assert_eq!(
            lines,
            [".......", ".##....", ".##....", ".......", "......."]
        );
        let (lines, gone) = kept(&["......", ".#..#.", "......"]);
        assert_eq!(
            (lines[1].as_str(), gone),
            (".#....", 1),
            "the first of equals"
        );
        let (lines, gone) = kept(&["....", "....", "...."]);
        assert_eq!((lines[1].as_str(), gone), ("....", 0));
    }

    #[test]
    fn hollows_are_filled_and_what_is_in_them_with_them() {
        let dims = USizeVec3::splat(9);
        let distance = |i: usize| {
            let at = USizeVec3::new(i % 9, i / 9 % 9, i / 81).as_ivec3() - 4;
            at.abs().max_element()
        };
        let mut shell: Vec<bool> = (0..729).map(|i| [0, 3].contains(&distance(i))).collect();
        assert_eq!(
            keep_largest(&mut shell, dims),
            1,
            "what is inside is a piece of its own"
        );
        let filled: Vec<bool> = (0..729).map(|i| distance(i) <= 3).collect();
        assert_eq!(shell, filled);
        // A hole, even across an edge, opens the hollow.
        let mut open: Vec<bool> = (0..729).map(|i| distance(i) == 3).collect();
        let edge = 1 + 9 * (1 + 9 * 4);
        open[edge] = false;
        let before = open.clone();
        assert_eq!(keep_largest(&mut open, dims), 0);
        assert_eq!(open, before, "nothing is filled");
    }
}
