//! From bytes to voxels, slab by slab: every scalar type in both byte orders.

use glam::UVec3;

use super::stream::Stream;
use super::{LoadError, LoadReport, Warning};
use crate::data::{SubjectPart, SubjectSink, Volume, Voxels};

/// Bytes of voxels handed to the sink at once, where a slice is not larger. Larger costs memory, smaller costs calls.
const SLAB_BYTES: u64 = 2 * 1024 * 1024;
/// Bytes decoded at once.
const CHUNK_BYTES: usize = 256 * 1024;
/// Larger magnitudes are clipped: differences of two values must stay finite in 32 bits, also when scaled.
pub(crate) const VALUE_LIMIT: f32 = 1e37;
/// Largest whole number up to which all are exact in 32-bit floats.
const EXACT_LIMIT: u64 = 1 << 24;

/// Scalar types that files have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementType {
    /// Unsigned 8-bit number.
    U8,
    /// Signed 8-bit number.
    I8,
    /// Unsigned 16-bit number.
    U16,
    /// Signed 16-bit number.
    I16,
    /// Unsigned 32-bit number.
    U32,
    /// Signed 32-bit number.
    I32,
    /// Unsigned 64-bit number.
    U64,
    /// Signed 64-bit number.
    I64,
    /// Floating-point number of 32 bits.
    F32,
    /// Floating-point number of 64 bits.
    F64,
    /// Two 32-bit floats; read as their magnitude.
    C64,
    /// Two 64-bit floats; read as their magnitude.
    C128,
}

impl ElementType {
    /// The usual name of the type, such as `int16`.
    pub fn name(self) -> &'static str {
        match self {
            Self::U8 => "uint8",
            Self::I8 => "int8",
            Self::U16 => "uint16",
            Self::I16 => "int16",
            Self::U32 => "uint32",
            Self::I32 => "int32",
            Self::U64 => "uint64",
            Self::I64 => "int64",
            Self::F32 => "float32",
            Self::F64 => "float64",
            Self::C64 => "complex64",
            Self::C128 => "complex128",
        }
    }

    /// The scalar type of a name; `None` for complex ones and unknown names.
    pub fn from_name(name: &str) -> Option<Self> {
        const SCALAR: [ElementType; 10] = [
            ElementType::U8,
            ElementType::I8,
            ElementType::U16,
            ElementType::I16,
            ElementType::U32,
            ElementType::I32,
            ElementType::U64,
            ElementType::I64,
            ElementType::F32,
            ElementType::F64,
        ];
        SCALAR.into_iter().find(|element| element.name() == name)
    }

    /// Bytes of one element in a file.
    pub fn byte_count(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 | Self::C64 => 8,
            Self::C128 => 16,
        }
    }

    /// What it is kept in, empty: the next type that holds all its values (float for 32-bit and more).
    pub fn kept_as(self) -> Voxels {
        match self {
            Self::U8 => Voxels::U8(Vec::new()),
            Self::I8 | Self::I16 => Voxels::I16(Vec::new()),
            Self::U16 => Voxels::U16(Vec::new()),
            _ => Voxels::F32(Vec::new()),
        }
    }

    /// Bytes of one voxel as kept.
    pub(crate) fn kept_bytes(self) -> u64 {
        match self.kept_as() {
            Voxels::U8(_) => 1,
            Voxels::I16(_) | Voxels::U16(_) => 2,
            Voxels::F32(_) => 4,
        }
    }

    /// True if every value of this type, scaled, is a number that can be shown. Floats are clipped when they come, if
    /// the scale leaves them room.
    pub(crate) fn can_be_scaled(self, slope: f32, intercept: f32) -> bool {
        let largest = match self {
            Self::U8 | Self::I8 => 255.0,
            Self::U16 | Self::I16 => 65_535.0,
            Self::U32 | Self::I32 => 4.3e9,
            Self::U64 | Self::I64 => 1.9e19,
            Self::F32 | Self::F64 | Self::C64 | Self::C128 => 1e20,
        };
        // A slope below the normal numbers would make all values one.
        slope.is_normal()
            && intercept.is_finite()
            && slope.abs() * largest + intercept.abs() <= 0.5 * VALUE_LIMIT
    }
}

/// How voxels lie in the bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layout {
    pub(crate) element: ElementType,
    pub(crate) big_endian: bool,
    pub(crate) dims: UVec3,
    /// Elements per voxel, one after the other.
    pub(crate) components: u32,
    /// The one that is taken.
    pub(crate) component: u32,
    /// The three or four elements are red, green, blue and opacity: their brightness is taken.
    pub(crate) is_color: bool,
}

impl Layout {
    /// Bytes of one volume, `None` if that is no 64-bit number.
    pub(crate) fn byte_count(&self) -> Option<u64> {
        let dims = self.dims.as_u64vec3();
        dims.x
            .checked_mul(dims.y)?
            .checked_mul(dims.z)?
            .checked_mul(u64::from(self.components))?
            .checked_mul(self.element.byte_count() as u64)
    }
}

/// Where voxel bytes come from: one file, a list of files, numbers in text.
pub(crate) trait VoxelSource {
    /// Fills the buffer as far as there are bytes; returns how many came.
    fn fill(&mut self, buf: &mut [u8]) -> Result<usize, LoadError>;
    /// Part that was read, if that is known.
    fn fraction(&mut self) -> Option<f32>;
    /// Name of the file, for messages.
    fn name(&self) -> String;
}

impl VoxelSource for Stream<'_> {
    fn fill(&mut self, buf: &mut [u8]) -> Result<usize, LoadError> {
        Stream::fill(self, buf)
    }

    fn fraction(&mut self) -> Option<f32> {
        Stream::fraction(self)
    }

    fn name(&self) -> String {
        Stream::name(self).to_owned()
    }
}

/// What was changed in values on the way.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    not_finite: u64,
    clipped: u64,
    rounded: u64,
    /// The number that all voxels so far have, stored; `None` once two differ.
    constant: Option<f32>,
    is_started: bool,
    /// Largest magnitude that a stored float may have.
    limit: f32,
}

impl Tally {
    fn watch_constant(&mut self, slab: &Voxels) {
        if !self.is_started {
            self.constant = slab.get(0);
            self.is_started = true;
        }
        let Some(constant) = self.constant else {
            return;
        };
        let all_equal = match slab {
            Voxels::U8(v) => v.iter().all(|&x| f32::from(x) == constant),
            Voxels::I16(v) => v.iter().all(|&x| f32::from(x) == constant),
            Voxels::U16(v) => v.iter().all(|&x| f32::from(x) == constant),
            Voxels::F32(v) => v.iter().all(|&x| x == constant),
        };
        if !all_equal {
            self.constant = None;
        }
    }
}

/// Collects voxels from one source after the other and hands them to the sink slab by slab. Holds no more than one
/// slab, and of a slab no more than the bytes that really came.
pub(crate) struct Slabs<'a> {
    layout: Layout,
    sink: &'a mut dyn SubjectSink,
    tally: Tally,
    chunk: Vec<u8>,
    slab: Voxels,
    /// Voxels that the slab in hand still lacks.
    slab_left: u64,
    /// Voxels of whole slabs.
    slab_voxels: u64,
    /// Voxels that have come.
    done: u64,
    total: u64,
}

impl<'a> Slabs<'a> {
    /// For a volume of this layout, whose header the sink has.
    pub(crate) fn new(layout: &Layout, header: &Volume, sink: &'a mut dyn SubjectSink) -> Self {
        let voxel_bytes = layout.element.byte_count() * layout.components as usize;
        let slice = u64::from(layout.dims.x) * u64::from(layout.dims.y);
        let slices = (SLAB_BYTES / (slice * layout.element.kept_bytes()).max(1))
            .clamp(1, u64::from(layout.dims.z));
        Self {
            layout: *layout,
            sink,
            tally: Tally {
                // Scaled, a value must stay within the limit.
                limit: VALUE_LIMIT / header.slope.abs().max(1.0),
                ..Tally::default()
            },
            chunk: vec![0; (CHUNK_BYTES / voxel_bytes).max(1) * voxel_bytes],
            slab: layout.element.kept_as(),
            slab_left: 0,
            slab_voxels: slice * slices,
            done: 0,
            total: slice.saturating_mul(u64::from(layout.dims.z)),
        }
    }

    /// Takes this many voxels from a source, or as many as the volume still lacks.
    pub(crate) fn pull(
        &mut self,
        source: &mut dyn VoxelSource,
        voxels: u64,
    ) -> Result<(), LoadError> {
        let voxel_bytes = self.layout.element.byte_count() * self.layout.components as usize;
        let mut left = voxels.min(self.total - self.done);
        while left > 0 {
            if self.slab_left == 0 {
                self.slab_left = self.slab_voxels.min(self.total - self.done);
                let first = self
                    .slab_left
                    .min(SLAB_BYTES / self.layout.element.kept_bytes());
                self.slab = self.layout.element.kept_as();
                reserve(&mut self.slab, first as usize);
            }
            let most = (self.chunk.len() / voxel_bytes) as u64;
            let count = left.min(self.slab_left).min(most);
            let want = count as usize * voxel_bytes;
            let got = source.fill(&mut self.chunk[..want])?;
            if got < want {
                return Err(LoadError::Truncated {
                    name: source.name(),
                    expected: self.layout.byte_count().unwrap_or(u64::MAX),
                    found: self.done.saturating_mul(voxel_bytes as u64) + got as u64,
                });
            }
            decode(
                &mut self.slab,
                &self.chunk[..want],
                &self.layout,
                &mut self.tally,
            );
            left -= count;
            self.slab_left -= count;
            self.done += count;
            if self.slab_left == 0 {
                let slab = std::mem::replace(&mut self.slab, self.layout.element.kept_as());
                self.tally.watch_constant(&slab);
                self.sink
                    .take(SubjectPart::Scalars(slab))
                    .map_err(LoadError::refused(&source.name()))?;
                let done = (self.done as f64 / self.total as f64) as f32;
                if !self.sink.progress(source.fraction().unwrap_or(done)) {
                    return Err(LoadError::Cancelled);
                }
            }
        }
        Ok(())
    }

    /// Tells the sink how far it is; false if it wants no more.
    pub(crate) fn progress(&mut self) -> bool {
        self.sink
            .progress((self.done as f64 / self.total as f64) as f32)
    }

    /// Reports what was changed in values on the way.
    pub(crate) fn finish(self, header: &Volume, report: &mut LoadReport) {
        let tally = self.tally;
        for (count, warning) in [
            (
                tally.not_finite,
                Warning::NotFinite {
                    count: tally.not_finite,
                },
            ),
            (
                tally.clipped,
                Warning::Clipped {
                    count: tally.clipped,
                },
            ),
            (
                tally.rounded,
                Warning::Rounded {
                    count: tally.rounded,
                },
            ),
        ] {
            if count > 0 {
                report.warn(warning);
            }
        }
        if let Some(stored) = tally.constant {
            report.warn(Warning::Constant {
                value: stored * header.slope + header.intercept,
            });
        }
    }
}

/// Reads one volume from one source.
pub(crate) fn stream_voxels(
    source: &mut dyn VoxelSource,
    layout: &Layout,
    header: &Volume,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let mut slabs = Slabs::new(layout, header, sink);
    slabs.pull(source, u64::MAX)?;
    slabs.finish(header, report);
    Ok(())
}

fn reserve(voxels: &mut Voxels, n: usize) {
    match voxels {
        Voxels::U8(v) => v.reserve_exact(n),
        Voxels::I16(v) => v.reserve_exact(n),
        Voxels::U16(v) => v.reserve_exact(n),
        Voxels::F32(v) => v.reserve_exact(n),
    }
}

/// Appends the elements of one component, converted by `convert`.
fn append<const N: usize, T>(
    out: &mut Vec<T>,
    bytes: &[u8],
    layout: &Layout,
    mut convert: impl FnMut([u8; N]) -> T,
) {
    if layout.components == 1 {
        out.extend(bytes.as_chunks::<N>().0.iter().map(|&raw| convert(raw)));
    } else {
        let stride = layout.components as usize;
        out.extend(
            bytes
                .as_chunks::<N>()
                .0
                .iter()
                .skip(layout.component as usize)
                .step_by(stride)
                .map(|&raw| convert(raw)),
        );
    }
}

fn from_float(x: f32, tally: &mut Tally) -> f32 {
    if !x.is_finite() {
        tally.not_finite += 1;
        0.0
    } else if x.abs() > tally.limit {
        tally.clipped += 1;
        x.clamp(-tally.limit, tally.limit)
    } else {
        x
    }
}

fn from_double(x: f64, tally: &mut Tally) -> f32 {
    if x.is_finite() && x.abs() > f64::from(tally.limit) {
        tally.clipped += 1;
        return tally.limit.copysign(x as f32);
    }
    from_float(x as f32, tally)
}

fn from_whole(x: f32, magnitude: u64, tally: &mut Tally) -> f32 {
    if magnitude > EXACT_LIMIT {
        tally.rounded += 1;
    }
    x
}

fn decode(out: &mut Voxels, bytes: &[u8], layout: &Layout, tally: &mut Tally) {
    /// One arm per type: the byte order is decided outside the loop.
    macro_rules! numbers {
        ($out:expr, $type:ty, $convert:expr) => {{
            const N: usize = size_of::<$type>();
            if layout.big_endian {
                append::<N, _>($out, bytes, layout, |raw| {
                    $convert(<$type>::from_be_bytes(raw))
                });
            } else {
                append::<N, _>($out, bytes, layout, |raw| {
                    $convert(<$type>::from_le_bytes(raw))
                });
            }
        }};
    }
    if layout.is_color {
        return decode_brightness(out, bytes, layout, tally);
    }
    match (layout.element, out) {
        (ElementType::U8, Voxels::U8(out)) if layout.components == 1 => {
            out.extend_from_slice(bytes)
        }
        (ElementType::U8, Voxels::U8(out)) => numbers!(out, u8, |x| x),
        (ElementType::I8, Voxels::I16(out)) => numbers!(out, i8, i16::from),
        (ElementType::I16, Voxels::I16(out)) => numbers!(out, i16, |x| x),
        (ElementType::U16, Voxels::U16(out)) => numbers!(out, u16, |x| x),
        (ElementType::U32, Voxels::F32(out)) => {
            numbers!(out, u32, |x: u32| from_whole(x as f32, u64::from(x), tally));
        }
        (ElementType::I32, Voxels::F32(out)) => {
            numbers!(out, i32, |x: i32| from_whole(
                x as f32,
                u64::from(x.unsigned_abs()),
                tally
            ));
        }
        (ElementType::U64, Voxels::F32(out)) => {
            numbers!(out, u64, |x: u64| from_whole(x as f32, x, tally));
        }
        (ElementType::I64, Voxels::F32(out)) => {
            numbers!(out, i64, |x: i64| from_whole(
                x as f32,
                x.unsigned_abs(),
                tally
            ));
        }
        (ElementType::F32, Voxels::F32(out)) => numbers!(out, f32, |x| from_float(x, tally)),
        (ElementType::F64, Voxels::F32(out)) => numbers!(out, f64, |x| from_double(x, tally)),
        (ElementType::C64, Voxels::F32(out)) => append::<8, _>(out, bytes, layout, |raw| {
            let [a, b, c, d, e, f, g, h] = raw;
            let (re, im) = if layout.big_endian {
                (
                    f32::from_be_bytes([a, b, c, d]),
                    f32::from_be_bytes([e, f, g, h]),
                )
            } else {
                (
                    f32::from_le_bytes([a, b, c, d]),
                    f32::from_le_bytes([e, f, g, h]),
                )
            };
            from_double(f64::from(re).hypot(f64::from(im)), tally)
        }),
        (ElementType::C128, Voxels::F32(out)) => append::<16, _>(out, bytes, layout, |raw| {
            let mut first = [0; 8];
            let mut second = [0; 8];
            first.copy_from_slice(&raw[..8]);
            second.copy_from_slice(&raw[8..]);
            let (re, im) = if layout.big_endian {
                (f64::from_be_bytes(first), f64::from_be_bytes(second))
            } else {
                (f64::from_le_bytes(first), f64::from_le_bytes(second))
            };
            from_double(re.hypot(im), tally)
        }),
        // `out` is always what `kept_as` gives.
        _ => {}
    }
}

/// Appends the brightness of colours: the luma of ITU-R BT.709 of the stored, gamma-coded values, in the range of their
/// type; where there is opacity, bytes are weighted by it, so that what is transparent is dark. Other types ignore it.
fn decode_brightness(out: &mut Voxels, bytes: &[u8], layout: &Layout, tally: &mut Tally) {
    const WEIGHTS: [f32; 3] = [0.2126, 0.7152, 0.0722];
    let element = layout.element.byte_count();
    let single = Layout {
        components: 1,
        component: 0,
        is_color: false,
        ..*layout
    };
    let stride = element * layout.components as usize;
    let mut parts = layout.element.kept_as();
    decode(&mut parts, bytes, &single, tally);
    for (index, voxel) in bytes.chunks_exact(stride).enumerate() {
        let first = index * layout.components as usize;
        let part = |i: usize| parts.get(first + i).unwrap_or(0.0);
        let mut luma: f32 = (0..3).map(|i| WEIGHTS[i] * part(i)).sum();
        if layout.components == 4 && element == 1 {
            luma *= f32::from(voxel.last().copied().unwrap_or(255)) / 255.0;
        }
        match out {
            // Weights that sum to one stay in the type's range.
            Voxels::U8(out) => out.push(luma.round() as u8),
            Voxels::I16(out) => out.push(luma.round() as i16),
            Voxels::U16(out) => out.push(luma.round() as u16),
            Voxels::F32(out) => out.push(luma),
        }
    }
}
