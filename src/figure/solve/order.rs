use glam::DVec2;

/// Sets up to this size are not divided further.
const LEAF: usize = 6;

/// An order in which unknowns are eliminated so that a factor has few entries: sets are split at the median of their
/// longer side, and what separates the halves comes last (nested dissection). `neighbours` holds for each unknown the
/// others that it meets in the matrix.
///
/// Gives the unknowns in their order. Unknowns without a place (those of whole rigid parts, which meet many others)
/// come last of all.
pub(crate) fn dissection(places: &[Option<DVec2>], neighbours: &[Vec<u32>]) -> Vec<u32> {
    let n = places.len();
    let mut dissection = Dissection {
        places,
        neighbours,
        side: vec![0; n],
        stamp: 0,
        order: Vec::with_capacity(n),
    };
    let placed = (0..n as u32)
        .filter(|i| places[*i as usize].is_some())
        .collect();
    dissection.divide(placed);
    let mut order = dissection.order;
    order.extend((0..n as u32).filter(|i| places[*i as usize].is_none()));
    order
}

struct Dissection<'a> {
    places: &'a [Option<DVec2>],
    neighbours: &'a [Vec<u32>],
    /// Per unknown the number of the last set that had it on its far side.
    side: Vec<u32>,
    stamp: u32,
    order: Vec<u32>,
}

impl Dissection<'_> {
    fn place(&self, i: u32) -> DVec2 {
        self.places[i as usize].unwrap_or(DVec2::ZERO)
    }

    fn divide(&mut self, mut set: Vec<u32>) {
        if set.len() <= LEAF {
            self.order.extend(set);
            return;
        }
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for i in &set {
            low = low.min(self.place(*i));
            high = high.max(self.place(*i));
        }
        let is_wide = high.x - low.x >= high.y - low.y;
        let key = |place: DVec2| if is_wide { place.x } else { place.y };
        let middle = set.len() / 2;
        let compare = |a: &u32, b: &u32| {
            key(self.place(*a))
                .total_cmp(&key(self.place(*b)))
                .then(a.cmp(b))
        };
        set.select_nth_unstable_by(middle, compare);
        let mut far = set.split_off(middle);
        // A selection leaves each half in an order of its own making.
        set.sort_unstable();
        far.sort_unstable();
        self.stamp += 1;
        for i in &far {
            self.side[*i as usize] = self.stamp;
        }
        let meets_far = |i: &u32| {
            self.neighbours[*i as usize]
                .iter()
                .any(|j| self.side[*j as usize] == self.stamp)
        };
        let (separator, near): (Vec<u32>, Vec<u32>) = set.into_iter().partition(meets_far);
        self.divide(near);
        self.divide(far);
        self.order.extend(separator);
    }
}
