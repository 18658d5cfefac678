//! Which images of many DICOM files make which volume: sorted by where they lie, never by name or number (PS3.3,
//! "Image Plane Module", "Multi-frame Functional Groups").

use glam::{DAffine3, DMat3, DVec3};

use super::Warning;
use super::dicom_data::{Item, Parsed, tag};
use super::dicom_pixels::PixelFormat;
use super::geometry;

/// Frames of one file at most.
pub(crate) const MAX_FRAMES: u64 = 1 << 16;
/// Slices closer than this are at the same place, mm.
const SAME_PLACE_MM: f64 = 1e-3;
/// Directions that differ less are the same.
const SAME_DIRECTION: f64 = 1e-3;
/// A distance that differs by less than this part from the usual one is the usual one.
const STEP_TOLERANCE: f64 = 0.15;
/// A stack may be this much longer with the slices that are missing than without.
const MAX_FILLED: usize = 4;
/// Tilt below this comes from rounded positions.
const MIN_TILT_DEG: f64 = 0.25;

/// One image of a file.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    /// Position of its file in the list of files, and its own in the file.
    pub(crate) file: usize,
    pub(crate) index: u64,
    /// Centre of the first pixel, mm, LPS; `None` if the file does not tell.
    position: Option<DVec3>,
    /// Directions of a row and of a column, LPS.
    row: DVec3,
    column: DVec3,
    /// Between columns, between rows, mm.
    spacing: Option<[f64; 2]>,
    /// Between slices, mm, where the file tells.
    step: Option<f64>,
    pub(crate) slope: f64,
    pub(crate) intercept: f64,
    /// What parts images at the same place: time, echo, number.
    order: [f64; 6],
    /// Number of the segment, if the file is a segmentation.
    pub(crate) segment: Option<u16>,
}

/// What a file brings.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) series: String,
    /// What made the images, as the standard abbreviates it; empty where the file does not tell.
    pub(crate) modality: String,
    pub(crate) format: PixelFormat,
    pub(crate) frame_count: u64,
    pub(crate) is_segmentation: bool,
    /// Frames follow each other in time, not in space.
    is_film: bool,
}

/// Images that make one volume, and how they lie.
#[derive(Clone, Debug)]
pub(crate) struct Stack {
    /// For each slice the frame (of a segmentation: frames) drawn there.
    pub(crate) slices: Vec<Vec<Frame>>,
    pub(crate) world_from_voxel: DAffine3,
    pub(crate) warnings: Vec<Warning>,
    pub(crate) series: String,
}

fn vector(numbers: &[f64]) -> Option<DVec3> {
    numbers.first_chunk::<3>().map(|&v| DVec3::from(v))
}

/// The frames of one file. An error tells in words why the file has none.
pub(crate) fn frames(
    parsed: &Parsed,
    name: &str,
    file: usize,
) -> Result<(Source, Vec<Frame>), String> {
    let root = &parsed.root;
    let format = PixelFormat::of(parsed)?;
    let count = root.decimal(tag::FRAME_COUNT).unwrap_or(1.0);
    if !(1.0..=MAX_FRAMES as f64).contains(&count) {
        return Err(format!("it says that it holds {count} images"));
    }
    let count = count as u64;
    let groups = root.items(tag::FRAME_GROUPS);
    let shared = root.items(tag::SHARED_GROUPS).first();
    let is_segmentation =
        root.text(tag::SOP_CLASS).as_deref() == Some("1.2.840.10008.5.1.4.1.1.66.4");
    let increment = root.shorts(tag::FRAME_INCREMENT);
    let offsets = root.decimals(tag::GRID_OFFSETS);
    let has_step = root.bytes(tag::SPACING_BETWEEN_SLICES).is_some()
        || root.bytes(tag::SLICE_THICKNESS).is_some();
    let points_to_time = increment.first() == Some(&0x0018);
    let is_film =
        groups.is_empty() && count > 1 && offsets.len() < 2 && (points_to_time || !has_step);
    let mut list = Vec::new();
    for index in 0..count {
        let group = groups.get(index as usize);
        // A frame's own elements go before those that all frames share, and these before the elements of the file.
        let within = |sequence: u32, wanted: u32| -> Option<&Item> {
            [group, shared]
                .into_iter()
                .flatten()
                .filter_map(|item| item.items(sequence).first())
                .find(|item| item.bytes(wanted).is_some())
                .or(Some(root))
        };
        let decimals = |sequence, wanted| {
            within(sequence, wanted).map_or(Vec::new(), |item| item.decimals(wanted))
        };
        let directions = decimals(tag::PLANE_ORIENTATION, tag::ORIENTATION);
        let mut row = vector(&directions).unwrap_or(DVec3::X).normalize_or_zero();
        let mut column = vector(directions.get(3..).unwrap_or_default())
            .unwrap_or(DVec3::Y)
            .normalize_or_zero();
        let is_plane = row.cross(column).length() > 0.5;
        if !is_plane {
            (row, column) = (DVec3::X, DVec3::Y);
        }
        let mut position = vector(&decimals(tag::PLANE_POSITION, tag::POSITION))
            .filter(|pos| is_plane && directions.len() == 6 && pos.abs().max_element() < 1e8);
        // Dose grids: one position, and how far each image lies from it.
        if let (Some(pos), Some(offset)) = (position, offsets.get(index as usize)) {
            position = Some(pos + row.cross(column) * *offset);
        } else if groups.is_empty() && count > 1 {
            position = None;
        }
        let mut spacing = decimals(tag::PIXEL_MEASURES, tag::PIXEL_SPACING);
        if spacing.len() != 2 {
            spacing = root.decimals(tag::IMAGER_PIXEL_SPACING);
        }
        let is_length = |mm: &f64| (1e-6..=1e6).contains(mm);
        let spacing = match spacing[..] {
            [between_rows, between_columns]
                if is_length(&between_rows) && is_length(&between_columns) =>
            {
                Some([between_columns, between_rows])
            }
            _ => None,
        };
        let step = [tag::SPACING_BETWEEN_SLICES, tag::SLICE_THICKNESS]
            .into_iter()
            .find_map(|wanted| {
                let found = decimals(tag::PIXEL_MEASURES, wanted)
                    .first()
                    .map(|mm| mm.abs());
                found.filter(is_length)
            });
        let value = |wanted| decimals(tag::PIXEL_VALUES, wanted).first().copied();
        let dose = root.decimal(tag::DOSE_SCALING);
        let number = |tag| root.decimal(tag).unwrap_or(0.0);
        let time = group
            .and_then(|group| group.items(tag::FRAME_CONTENT).first())
            .and_then(|content| content.long(tag::TEMPORAL_POSITION_INDEX));
        list.push(Frame {
            file,
            index,
            position,
            row,
            column,
            spacing,
            step,
            slope: value(tag::SLOPE).or(dose).unwrap_or(1.0),
            intercept: value(tag::INTERCEPT).unwrap_or(0.0),
            order: [
                time.map_or_else(|| number(tag::TEMPORAL_POSITION), f64::from),
                number(tag::ACQUISITION_NUMBER),
                number(tag::ECHO_TIME),
                number(tag::TRIGGER_TIME),
                number(tag::INSTANCE_NUMBER),
                index as f64,
            ],
            segment: is_segmentation.then(|| {
                let found = within(tag::SEGMENT_IDENTIFICATION, tag::REFERENCED_SEGMENT);
                found
                    .and_then(|item| item.short(tag::REFERENCED_SEGMENT))
                    .unwrap_or(1)
            }),
        });
    }
    let source = Source {
        name: name.to_owned(),
        series: root.text(tag::SERIES).unwrap_or_default(),
        modality: root.text(tag::MODALITY).unwrap_or_default(),
        format,
        frame_count: count,
        is_segmentation,
        is_film,
    };
    Ok((source, list))
}

impl Frame {
    fn normal(&self) -> DVec3 {
        self.row.cross(self.column)
    }

    /// How far along the normal, mm; by number where no position is told.
    fn height(&self) -> f64 {
        self.position.map_or(0.0, |pos| pos.dot(self.normal()))
    }

    fn is_parallel(&self, other: &Self) -> bool {
        self.row.abs_diff_eq(other.row, SAME_DIRECTION)
            && self.column.abs_diff_eq(other.column, SAME_DIRECTION)
            && self.position.is_some() == other.position.is_some()
            && match (self.spacing, other.spacing) {
                (Some(a), Some(b)) => (0..2).all(|i| (a[i] - b[i]).abs() <= 1e-3 * a[i]),
                (a, b) => a.is_none() && b.is_none(),
            }
    }
}

/// All volumes that the frames make, the one with the most slices first.
pub(crate) fn stacks(sources: &[Source], frames: Vec<Frame>) -> Vec<Stack> {
    let mut groups: Vec<Vec<Frame>> = Vec::new();
    for frame in frames {
        let source = &sources[frame.file];
        let belongs = |group: &&mut Vec<Frame>| {
            group.first().is_some_and(|first| {
                let other = &sources[first.file];
                first.is_parallel(&frame)
                    && source.series == other.series
                    && source.format == other.format
                    && source.is_segmentation == other.is_segmentation
                    && !source.is_film
                    && !other.is_film
            })
        };
        // Files of a series mostly come one after the other, so that the last group is looked at first.
        match groups.iter_mut().rev().take(64).find(belongs) {
            Some(group) => group.push(frame),
            None => groups.push(vec![frame]),
        }
    }
    let mut stacks: Vec<Stack> = groups
        .into_iter()
        .flat_map(|group| volumes(&sources[group[0].file], group))
        .collect();
    let is_drawn = |stack: &Stack| {
        let first = stack.slices.iter().flatten().next();
        first.is_some_and(|frame| frame.segment.is_some())
    };
    // Scans come before overlays that were drawn on them.
    stacks.sort_by(|a, b| {
        let order = |stack: &Stack| {
            stack
                .slices
                .first()
                .and_then(|s| s.first())
                .map_or([0.0; 6], |f| f.order)
        };
        is_drawn(a)
            .cmp(&is_drawn(b))
            .then_with(|| b.slices.len().cmp(&a.slices.len()))
            .then_with(|| a.series.cmp(&b.series))
            .then_with(|| by_order(order(a), order(b)))
    });
    stacks
}

fn by_order(a: [f64; 6], b: [f64; 6]) -> std::cmp::Ordering {
    let differing = a.iter().zip(&b).find(|(a, b)| a != b);
    differing.map_or(std::cmp::Ordering::Equal, |(a, b)| a.total_cmp(b))
}

/// Parts parallel images into volumes: several at each place follow each other in time.
fn volumes(source: &Source, mut group: Vec<Frame>) -> Vec<Stack> {
    let has_positions = group.iter().all(|frame| frame.position.is_some());
    group.sort_by(|a, b| {
        a.height()
            .total_cmp(&b.height())
            .then_with(|| by_order(a.order, b.order))
            .then_with(|| a.file.cmp(&b.file))
    });
    let mut places: Vec<Vec<Frame>> = Vec::new();
    for frame in group {
        match places.last_mut() {
            Some(place)
                if has_positions && (place[0].height() - frame.height()).abs() < SAME_PLACE_MM =>
            {
                place.push(frame);
            }
            _ => places.push(vec![frame]),
        }
    }
    if source.is_segmentation {
        return vec![stack(source, places, Vec::new())];
    }
    let count = places[0].len();
    if places.iter().all(|place| place.len() == count) {
        return (0..count)
            .map(|i| {
                stack(
                    source,
                    places.iter().map(|place| vec![place[i].clone()]).collect(),
                    Vec::new(),
                )
            })
            .collect();
    }
    let doubled = places.iter().map(|place| place.len() as u64 - 1).sum();
    let first = places
        .into_iter()
        .map(|place| vec![place[0].clone()])
        .collect();
    vec![stack(
        source,
        first,
        vec![Warning::DoubledSlices { count: doubled }],
    )]
}

/// Lays slices, sorted by height, on a grid.
fn stack(source: &Source, mut places: Vec<Vec<Frame>>, mut warnings: Vec<Warning>) -> Stack {
    let first = places[0][0].clone();
    let normal = first.normal();
    let heights: Vec<f64> = places.iter().map(|place| place[0].height()).collect();
    let mut step = first.step.unwrap_or(1.0);
    let mut along = normal;
    if let (Some(start), Some(end)) = (
        first.position,
        places.last().and_then(|place| place[0].position),
    ) && places.len() > 1
    {
        let mut steps: Vec<f64> = heights.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let told = first.step.filter(|_| source.is_segmentation);
        let usual = told.unwrap_or_else(|| {
            let mut sorted = steps.clone();
            sorted.sort_by(f64::total_cmp);
            sorted[sorted.len() / 2]
        });
        let counts: Vec<usize> = steps
            .iter()
            .map(|step| (step / usual).round().clamp(1.0, 1e6) as usize)
            .collect();
        let is_even = steps
            .iter()
            .zip(&counts)
            .all(|(step, &count)| (step - usual * count as f64).abs() <= STEP_TOLERANCE * usual);
        let total = 1 + counts.iter().sum::<usize>();
        let missing = total - places.len();
        if is_even && missing > 0 && (source.is_segmentation || total <= MAX_FILLED * places.len())
        {
            // Where slices are missing, a segmentation has nothing; a scan shows the nearer neighbour.
            if !source.is_segmentation {
                warnings.push(Warning::MissingSlices {
                    count: missing as u64,
                });
            }
            let mut filled = Vec::with_capacity(total);
            for (i, &count) in counts.iter().enumerate() {
                filled.push(places[i].clone());
                for k in 1..count {
                    let neighbour = if 2 * k < count { i } else { i + 1 };
                    filled.push(if source.is_segmentation {
                        Vec::new()
                    } else {
                        places[neighbour].clone()
                    });
                }
            }
            filled.extend(places.pop());
            places = filled;
        } else if !is_even {
            steps.sort_by(f64::total_cmp);
            warnings.push(Warning::UnevenSlices {
                smallest_mm: steps[0],
                largest_mm: steps[steps.len() - 1],
            });
        }
        let whole = (end - start) / (places.len() - 1) as f64;
        step = whole.length();
        along = whole.normalize_or(normal);
        let tilt = along.dot(normal).clamp(-1.0, 1.0).acos().to_degrees();
        if tilt > MIN_TILT_DEG {
            warnings.push(Warning::Tilted { degrees: tilt });
        }
    } else if first.position.is_none() && !places.is_empty() {
        warnings.push(Warning::NoOrientation);
    }
    let [between_columns, between_rows] = first.spacing.unwrap_or_else(|| {
        warnings.push(Warning::NoPixelSpacing);
        [1.0; 2]
    });
    // LPS to RAS.
    let ras = |v: DVec3| DVec3::new(-v.x, -v.y, v.z);
    let mut world_from_voxel = DAffine3 {
        matrix3: DMat3::from_cols(
            ras(first.row * between_columns),
            ras(first.column * between_rows),
            ras(along * step),
        ),
        translation: ras(first.position.unwrap_or(DVec3::ZERO)),
    };
    if first.position.is_none() {
        // Rows from the top, as pictures lie.
        world_from_voxel = geometry::unoriented(DVec3::new(between_columns, between_rows, step));
    }
    if !geometry::is_usable(&world_from_voxel) {
        warnings.push(Warning::BadOrientation {
            field: "Image Orientation (Patient) and Pixel Spacing",
            instead: "the grid's own",
        });
        world_from_voxel = geometry::unoriented(DVec3::ONE);
    }
    Stack {
        slices: places,
        world_from_voxel,
        warnings,
        series: source.series.clone(),
    }
}
