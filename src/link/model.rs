//! Format version 1's coder: an adaptive model of illustration documents drives a binary arithmetic coder.
//!
//! A short text gains little from deflate, which has to see a string before it can refer to it. Here several
//! predictors guess the next bit, each from another part of the text so far (the last bytes, the word, the place in the
//! JSON tree). A small mixer, trained on the way, weighs their guesses, and the arithmetic coder spends the fewer bits
//! the better the mixture was (the scheme of PAQ: Mahoney, *Adaptive weighing of context models for lossless data
//! compression*, 2005). Before the first byte the model reads a fixed text of typical documents, so that it starts with
//! their statistics.
//!
//! Everything is whole-number arithmetic: the same bits on every machine, for ever. **Any change of a constant, of the
//! contexts or of the priming text changes the format**, and belongs into a new version.

/// Typical documents, read before the first byte. Frozen with the format.
const PRIMING: &str = include_str!("v1.txt");

/// How a document begins; not coded.
pub(super) const OPENING: &str = "{\"fabrica\":1";

/// Entries of one predictor's table, as a power of two.
const TABLE_BITS: u32 = 17;
/// Number of predictors, each with a table and a context of its own.
const N: usize = 11;
/// Inputs of the mixer: one per predictor and a bias.
const INPUTS: usize = N + 1;

/// 65536 / (1 + e^−x) for x from −12 to 12 in quarters.
const LOGISTIC: [u32; 97] = [
    0, 1, 1, 1, 1, 1, 2, 2, 3, 4, 5, 6, 8, 10, 13, 17, 22, 28, 36, 47, 60, 77, 98, 126, 162, 208,
    267, 342, 439, 562, 720, 922, 1179, 1506, 1921, 2446, 3108, 3938, 4971, 6249, 7812, 9702,
    11955, 14595, 17625, 21025, 24743, 28693, 32768, 36843, 40793, 44511, 47911, 50941, 53581,
    55834, 57724, 59287, 60565, 61598, 62428, 63090, 63615, 64030, 64357, 64614, 64816, 64974,
    65097, 65194, 65269, 65328, 65374, 65410, 65438, 65459, 65476, 65489, 65500, 65508, 65514,
    65519, 65523, 65526, 65528, 65530, 65531, 65532, 65533, 65534, 65534, 65535, 65535, 65535,
    65535, 65535, 65536,
];

/// Probability (of 65536) from its log-odds in 256ths.
fn squash(x: i32) -> u32 {
    let x = x.clamp(-3071, 3071) + 3072;
    let (i, part) = ((x >> 6) as usize, (x & 63) as u32);
    let value = (LOGISTIC[i] * (64 - part) + LOGISTIC[i + 1] * part + 32) >> 6;
    value.clamp(6, 65530)
}

/// The inverse of [`squash`], for probabilities in 4096ths.
fn stretch_table() -> Vec<i16> {
    let mut table = vec![0_i16; 4096];
    let mut x = -3071;
    for (p, slot) in table.iter_mut().enumerate() {
        let target = (p as u32 * 2 + 1) * 8;
        while x < 3071 && squash(x) < target {
            x += 1;
        }
        *slot = x as i16;
    }
    table
}

/// The place in the JSON text, as far as the predictors use it.
#[derive(Clone)]
struct Place {
    /// The last eight bytes, newest lowest.
    last: u64,
    /// Hash of the letters since the last other byte, and of the word before.
    word: u32,
    /// Hash of the word before `word`.
    word_before: u32,
    is_in_string: bool,
    is_escaped: bool,
    /// Hash of the key whose value is read, per open array or object; `index` counts entries.
    open: Vec<Level>,
    /// Hash of the string that is being read, or else of the last one.
    string: u32,
    /// Bytes since the value began.
    since: u32,
    /// Hash of the bytes since the value began.
    value: u32,
}

#[derive(Clone, Copy)]
struct Level {
    is_array: bool,
    key: u32,
    index: u32,
}

fn hash(a: u32, b: u32) -> u32 {
    let h = (a ^ b.rotate_left(13)).wrapping_mul(0x9e37_79b1);
    (h ^ (h >> 15)).wrapping_mul(0x85eb_ca6b)
}

impl Place {
    fn new() -> Self {
        Self {
            last: 0,
            word: 0,
            word_before: 0,
            is_in_string: false,
            is_escaped: false,
            open: Vec::new(),
            string: 0,
            since: 0,
            value: 0,
        }
    }

    /// Takes the next byte. True if it closed the outermost value.
    fn push(&mut self, byte: u8) -> bool {
        self.last = (self.last << 8) | u64::from(byte);
        if byte.is_ascii_alphabetic() || byte >= 128 {
            self.word = hash(self.word, u32::from(byte.to_ascii_lowercase()) + 1);
        } else if self.word != 0 {
            self.word_before = self.word;
            self.word = 0;
        }
        self.since += 1;
        self.value = hash(self.value, u32::from(byte) + 7);
        if self.is_in_string {
            if self.is_escaped {
                self.is_escaped = false;
            } else if byte == b'\\' {
                self.is_escaped = true;
            } else if byte == b'"' {
                self.is_in_string = false;
                return false;
            }
            // A pointer in a step's `set` is a path; its digits are indices of templates and say nothing about the
            // value.
            if !byte.is_ascii_digit() {
                self.string = hash(self.string, u32::from(byte));
            }
            return false;
        }
        let mut value_begins = true;
        match byte {
            b'"' => {
                self.is_in_string = true;
                self.string = 0;
                value_begins = false;
            }
            b'{' | b'[' => {
                let key = self.open.last().map_or(0, |level| level.key);
                self.open.push(Level {
                    is_array: byte == b'[',
                    key: hash(key, 3),
                    index: 0,
                });
            }
            b'}' | b']' => {
                self.open.pop();
                if self.open.is_empty() {
                    return true;
                }
            }
            b',' => {
                if let Some(level) = self.open.last_mut() {
                    level.index += 1;
                }
            }
            b':' => {
                let string = self.string;
                if let Some(level) = self.open.last_mut() {
                    level.key = string;
                }
            }
            _ => value_begins = false,
        }
        if value_begins {
            self.since = 0;
            self.value = 0;
        }
        false
    }

    /// One hash per predictor.
    fn contexts(&self) -> [u32; N] {
        let last = |bytes: u32| (self.last & ((1_u64 << (8 * bytes)) - 1)) as u32;
        let long = |bytes: u32| {
            let kept = if bytes == 8 {
                self.last
            } else {
                self.last & ((1_u64 << (8 * bytes)) - 1)
            };
            hash(kept as u32, (kept >> 32) as u32)
        };
        let (key, index, is_array) = self.open.last().map_or((0, 0, false), |level| {
            (level.key, level.index, level.is_array)
        });
        let kind = u32::from(self.is_in_string) * 2 + u32::from(is_array);
        let slot = hash(key, if is_array { index } else { 99 });
        [
            kind,
            hash(last(1), kind),
            last(2),
            last(3),
            last(4),
            long(5),
            long(7),
            hash(self.word, last(1)),
            hash(self.word, hash(self.word_before, 5)),
            // Numbers: how this slot of this key usually goes on, whatever stands before it.
            hash(slot, hash(self.since.min(12), kind)),
            hash(slot, hash(self.value, 11)),
        ]
    }
}

/// The adaptive model: tables of all predictors, the mixer's weights, and the place in the text.
#[derive(Clone)]
pub(super) struct Model {
    /// Per predictor and hashed context: probability of a 1 (upper 22 bits), and how often the context was seen (lower
    /// 10).
    tables: Vec<u32>,
    weights: Vec<[i32; INPUTS]>,
    weights_2: Vec<[i32; INPUTS]>,
    stretch: Vec<i16>,
    /// Rates of adaptation by count, 65536 / (n + 1.5).
    rates: [i64; 256],
    place: Place,
    contexts: [u32; N],
    /// Bits of the byte so far, with a leading 1.
    partial: u32,
    // Found by `predict` for the coming bit, and used by `update`.
    slots: [usize; N],
    inputs: [i32; INPUTS],
    set: usize,
    set_2: usize,
    p_1: u32,
    p_2: u32,
}

/// Number of times seen at which the rate of adaptation of a context stays constant.
const COUNT_LIMIT: u32 = 255;
/// Speed of the mixer's training.
const MIXER_RATE: i32 = 14;
/// Weight of each predictor before training, of 65536.
const FIRST_WEIGHT: i32 = 8000;
/// Weight of a prediction by how often its context was seen, in 64ths; a context that was never seen has none.
const TRUST: [i32; 8] = [0, 72, 68, 66, 64, 64, 64, 64];

impl Model {
    /// Reads the priming text: some milliseconds.
    pub(super) fn new() -> Self {
        let mut model = Self {
            tables: vec![(1 << 31) & !0x3ff; N << TABLE_BITS],
            weights: vec![[FIRST_WEIGHT; INPUTS]; (N + 1) * 4],
            weights_2: vec![[FIRST_WEIGHT; INPUTS]; 256],
            stretch: stretch_table(),
            rates: std::array::from_fn(|n| 2 * 65536 / (2 * n as i64 + 3)),
            place: Place::new(),
            contexts: [0; N],
            partial: 1,
            slots: [0; N],
            inputs: [0; INPUTS],
            set: 0,
            set_2: 0,
            p_1: 0,
            p_2: 0,
        };
        model.contexts = model.place.contexts();
        for line in PRIMING.lines() {
            model.read(OPENING);
            model.read(line);
            model.place = Place::new();
            model.contexts = model.place.contexts();
        }
        model.read(OPENING);
        model
    }

    fn read(&mut self, text: &str) {
        for byte in text.bytes() {
            for i in (0..8).rev() {
                self.predict();
                self.update(u32::from(byte >> i) & 1);
            }
        }
    }

    /// Probability that the next bit is 1, of 65536.
    fn predict(&mut self) -> u32 {
        let mut seen = 0;
        for i in 0..N {
            let h = hash(
                self.contexts[i],
                self.partial
                    .wrapping_mul(0x2545_f491)
                    .wrapping_add(i as u32),
            );
            let slot = (i << TABLE_BITS) + (h >> (32 - TABLE_BITS)) as usize;
            self.slots[i] = slot;
            let entry = self.tables[slot];
            let count = (entry & 0x3ff) as usize;
            let odds = i32::from(self.stretch[(entry >> 20) as usize]);
            self.inputs[i] = (odds * TRUST[count.min(7)]) >> 6;
            if (2..7).contains(&i) && count > 0 {
                seen = i - 1;
            }
        }
        self.inputs[N] = 256;
        self.set = seen * 4
            + usize::from(self.place.is_in_string) * 2
            + usize::from(self.place.open.last().is_some_and(|level| level.is_array));
        self.set_2 = self.partial as usize;
        let dot = |weights: &[i32; INPUTS]| {
            let sum: i64 = weights
                .iter()
                .zip(&self.inputs)
                .map(|(w, x)| i64::from(*w) * i64::from(*x))
                .sum();
            (sum >> 16).clamp(-3071, 3071) as i32
        };
        let (x_1, x_2) = (
            dot(&self.weights[self.set]),
            dot(&self.weights_2[self.set_2]),
        );
        self.p_1 = squash(x_1);
        self.p_2 = squash(x_2);
        squash((x_1 + x_2) >> 1)
    }

    /// Learns the bit that came. True if it closed the document.
    fn update(&mut self, bit: u32) -> bool {
        for slot in self.slots {
            let entry = self.tables[slot];
            let count = entry & 0x3ff;
            let p = i64::from(entry >> 10);
            let target = if bit == 1 { (1_i64 << 22) - 1 } else { 0 };
            let p = p + (((target - p) * self.rates[count as usize]) >> 16);
            self.tables[slot] = ((p as u32) << 10) | (count + 1).min(COUNT_LIMIT);
        }
        let train = |weights: &mut [i32; INPUTS], inputs: &[i32; INPUTS], p: u32| {
            let error = ((bit << 16) as i32 - p as i32) * MIXER_RATE;
            for (w, x) in weights.iter_mut().zip(inputs) {
                let step = (i64::from(*x) * i64::from(error) + (1 << 17)) >> 18;
                *w = (i64::from(*w) + step).clamp(-(1 << 20), 1 << 20) as i32;
            }
        };
        train(&mut self.weights[self.set], &self.inputs, self.p_1);
        train(&mut self.weights_2[self.set_2], &self.inputs, self.p_2);
        self.partial = (self.partial << 1) | bit;
        if self.partial < 256 {
            return false;
        }
        let is_end = self.place.push((self.partial & 255) as u8);
        self.partial = 1;
        self.contexts = self.place.contexts();
        is_end
    }
}

/// Codes the rest of a document whose [`OPENING`] the model has read. The text must end where its outermost brace
/// closes; text after that brace would be lost.
pub(super) fn compress(mut model: Model, rest: &[u8]) -> Vec<u8> {
    let (mut low, mut high) = (0_u32, u32::MAX);
    let mut out = Vec::new();
    for byte in rest {
        for i in (0..8).rev() {
            let bit = u32::from(byte >> i) & 1;
            let mid = split(low, high, model.predict());
            if bit == 1 {
                high = mid;
            } else {
                low = mid + 1;
            }
            model.update(bit);
            while (low ^ high) >> 24 == 0 {
                out.push((high >> 24) as u8);
                low <<= 8;
                high = (high << 8) | 255;
            }
        }
    }
    // The fewest bytes that, followed by zeros, lie in the interval.
    for bytes in 0..=4_u32 {
        let unit = 32 - 8 * bytes;
        let value = if bytes == 0 {
            0
        } else {
            (u64::from(low) + (1_u64 << unit) - 1) >> unit << unit
        };
        if value >= u64::from(low) && value <= u64::from(high) {
            out.extend((value as u32).to_be_bytes().iter().take(bytes as usize));
            break;
        }
    }
    while out.last() == Some(&0) {
        out.pop();
    }
    out
}

fn split(low: u32, high: u32, p: u32) -> u32 {
    low + ((u64::from(high - low) * u64::from(p)) >> 16) as u32
}

/// Why [`decompress`] found no document.
pub(super) enum Broken {
    /// The document does not end within `limit` bytes.
    TooLarge,
    /// The code ended before the document did.
    Short,
}

/// Reads what [`compress`] wrote, at most `limit` bytes.
pub(super) fn decompress(mut model: Model, code: &[u8], limit: usize) -> Result<Vec<u8>, Broken> {
    let (mut low, mut high) = (0_u32, u32::MAX);
    let mut bytes = code.iter().copied();
    let mut beyond = 0;
    let mut next = || {
        bytes.next().unwrap_or_else(|| {
            beyond += 1;
            0
        })
    };
    let mut value = u32::from_be_bytes([next(), next(), next(), next()]);
    let mut out = Vec::new();
    let mut byte = 0_u8;
    let mut taken = 0_usize;
    for bit_index in 0.. {
        let mid = split(low, high, model.predict());
        let bit = u32::from(value <= mid);
        if bit == 1 {
            high = mid;
        } else {
            low = mid + 1;
        }
        byte = (byte << 1) | bit as u8;
        let is_end = model.update(bit);
        if bit_index & 7 == 7 {
            if out.len() == limit {
                return Err(Broken::TooLarge);
            }
            out.push(byte);
        }
        if is_end {
            return Ok(out);
        }
        while (low ^ high) >> 24 == 0 {
            low <<= 8;
            high = (high << 8) | 255;
            value = (value << 8) | u32::from(next());
            taken += 1;
        }
        // Zeros were trimmed from the end, but never this many.
        if taken > code.len() + 64 {
            return Err(Broken::Short);
        }
    }
    Err(Broken::Short)
}
