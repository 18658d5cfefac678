//! What clay costs: the ratios and counts of `fabrica bench --clay`. All of it by the processor alone.

use std::fmt;
use std::hint::black_box;

use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use super::error::ClayError;
use super::mesh::{ClayMesh, Vertex};
use super::motion::{Motion, Step, is_in};
use super::refine::Work;
use super::shaping::Shaping;
use super::space::Space;
use crate::data::Grids;
use crate::data::{Limited, median};
use crate::displace::ToolShape;
use crate::document::{Clay, ClayKey, ClayMove, ClayStroke, ClayTool};

/// Rounds in which the times of a drag are taken, and those of a recipe. The median counts.
const DRAG_ROUNDS: usize = 7;
const RECIPE_ROUNDS: usize = 5;
/// Edges of the sheet that is dragged, subject units, and its detail. Diagonals are shorter than the detail, sides
/// longer than half of it: at rest no edge asks for anything.
const SPACING: f64 = 0.0025;
const DETAIL: f64 = 0.004;
/// Squares along a side of the sheets: of the one on which a step is compared with the field; of one with 30,000
/// triangles; and of one near the limit of 300,000, with room for those that splits add.
const SQUARES: i32 = 200;
const FEW_SQUARES: i32 = 122;
const MANY_SQUARES: i32 = 380;
/// Radius and coating of the tool that has some 20,000 vertices of a sheet in reach, and of one that fits on the
/// smallest sheet, subject units.
const WIDE: f32 = 0.1;
const NARROW: f32 = 0.05;
/// A replay takes no longer than the strokes live: to what two times of the same work differ by.
const AS_LONG: f64 = 1.05;
/// Strokes of the recipe, and the seed of its random numbers.
const STROKES: usize = 24;
const SEED: u32 = 19;

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct ClayBench {
    /// What has a limit, in the order in which [`bench_clay`] names it.
    pub limits: Vec<Limited>,
    /// Vertices in reach of the step that is compared with the field, on average.
    pub in_reach: f64,
    /// That step, and the field once at each of its vertices, seconds.
    pub step_seconds: [f64; 2],
    /// A step on few triangles and on many, seconds.
    pub sheet_seconds: [f64; 2],
    /// Triangles of these two.
    pub sheet_triangles: [usize; 2],
    /// The recipe's strokes, one by one with the mesh that each leaves, and all at once, seconds.
    pub recipe_seconds: [f64; 2],
    /// Strokes of the recipe.
    pub strokes: usize,
    /// Vertices after all of them.
    pub vertices: usize,
    /// Triangles after all of them.
    pub triangles: usize,
    /// What was done for them, the start apart.
    pub work: Work,
}

/// Measures clay: a step, edges and normals included, to evaluating the field once at each vertex in reach and writing
/// it back; the same step on ten times as many triangles; a recipe replayed to its strokes done one by one, as a hand
/// does them; its steps to the fewest that keep to an eighth of a coating; and the bytes of a vertex, the most after
/// any stroke. The recipe is the same every time. `clock` gives seconds.
///
/// # Errors
/// [`ClayError`] if this version cannot make the clays that are measured, which a test holds that it can.
pub fn bench_clay(clock: fn() -> f64) -> Result<ClayBench, ClayError> {
    measured(clock, [DRAG_ROUNDS, RECIPE_ROUNDS])
}

fn measured(clock: fn() -> f64, rounds: [usize; 2]) -> Result<ClayBench, ClayError> {
    let wide = Drag::new(SQUARES, WIDE)?;
    let sheets = [
        Drag::new(FEW_SQUARES, NARROW)?,
        Drag::new(MANY_SQUARES, NARROW)?,
    ];
    let mut times = [const { Vec::new() }; 4];
    let mut work = Work::default();
    // In turns: whatever else the machine does meets all alike.
    for _ in 0..rounds[0] {
        let (seconds, done) = wide.step(clock)?;
        work = done;
        let all = [
            seconds,
            wide.field(clock)?,
            sheets[0].step(clock)?.0,
            sheets[1].step(clock)?.0,
        ];
        for (times, seconds) in times.iter_mut().zip(all) {
            times.push(seconds);
        }
    }
    let [step, field, few, many] = times.map(|mut times| median(&mut times));
    let in_reach = work.reached as f64 / work.steps.max(1) as f64;
    let field = field * in_reach;

    let recipe = Recipe::new()?;
    let mut times = [const { Vec::new() }; 2];
    let mut made = recipe.start.clone();
    let mut bytes = 0.0;
    for _ in 0..rounds[1] {
        let (seconds, most) = recipe.live(clock)?;
        bytes = most;
        times[0].push(seconds);
        let (seconds, shaping) = recipe.replay(clock)?;
        made = shaping;
        times[1].push(seconds);
    }
    let [live, replay] = times.map(|mut times| median(&mut times));
    let work = made.work().since(recipe.start.work());
    let limited = |name, value, limit| Limited { name, value, limit };
    Ok(ClayBench {
        limits: vec![
            limited(
                "a step, to the field once at each vertex",
                step / field,
                25.0,
            ),
            limited("a step on ten times as many triangles", many / few, 1.3),
            limited(
                "a recipe replayed, to its strokes live",
                replay / live,
                AS_LONG,
            ),
            limited(
                "its steps, to the fewest that may be",
                work.steps as f64 / recipe.fewest as f64,
                1.2,
            ),
            limited("bytes of a vertex", bytes, 200.0),
        ],
        in_reach,
        step_seconds: [step, field],
        sheet_seconds: [few, many],
        sheet_triangles: sheets.each_ref().map(|drag| drag.start.triangle_count()),
        recipe_seconds: [live, replay],
        strokes: recipe.clay.strokes.len(),
        vertices: made.vertex_count(),
        triangles: made.triangle_count(),
        work,
    })
}

impl ClayBench {
    /// All of it as JSON: `limits`, counts of the recipe, and times in milliseconds.
    pub fn to_json(&self) -> Value {
        let ms = |seconds: [f64; 2]| seconds.map(|seconds| 1e3 * seconds);
        let ([step, field], [few, many]) = (ms(self.step_seconds), ms(self.sheet_seconds));
        let [live, replay] = ms(self.recipe_seconds);
        let work = self.work;
        json!({
            "limits": self.limits.iter().map(Limited::to_json).collect::<Vec<_>>(),
            "strokes": self.strokes, "vertices": self.vertices, "triangles": self.triangles,
            "steps": work.steps, "reached": work.reached,
            "splits": work.splits, "collapses": work.collapses, "flips": work.flips,
            "in_reach": self.in_reach, "step_ms": step, "field_ms": field,
            "sheet_triangles": self.sheet_triangles, "sheet_ms": [few, many],
            "live_ms": live, "replay_ms": replay,
        })
    }
}

impl fmt::Display for ClayBench {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.limits
            .iter()
            .try_for_each(|row| writeln!(f, "{row}"))?;
        let ms = |seconds: f64| 1e3 * seconds;
        let [step, field] = self.step_seconds.map(ms);
        writeln!(
            f,
            "a step with {:.0} vertices in reach {step:.2} ms, the field at each {field:.3} ms",
            self.in_reach
        )?;
        let ([few, many], [small, large]) = (self.sheet_seconds.map(ms), self.sheet_triangles);
        writeln!(
            f,
            "a step on {small} triangles {few:.2} ms, on {large} {many:.2} ms"
        )?;
        let ([live, replay], work) = (self.recipe_seconds.map(ms), self.work);
        writeln!(
            f,
            "{} strokes live {live:.0} ms, replayed {replay:.0} ms: {} vertices, {} triangles, {} steps, {} splits, {} \
             collapses, {} flips",
            self.strokes,
            self.vertices,
            self.triangles,
            work.steps,
            work.splits,
            work.collapses,
            work.flips
        )
    }
}

/// A ball that drags the middle of a flat open sheet over one coating, sideways and up, so that edges become long
/// behind it and short before it.
struct Drag {
    clay: Clay,
    start: Shaping,
}

impl Drag {
    fn new(squares: i32, radius: f32) -> Result<Self, ClayError> {
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        let half = squares / 2;
        let at = |x: i32, y: i32| ((y + half) * (squares + 1) + x + half) as u32;
        for y in -half..=half {
            for x in -half..=half {
                let place = SPACING * DVec3::new(f64::from(x), f64::from(y), 0.0);
                vertices.push(Vertex::new(place, DVec3::Z));
                if x < half && y < half {
                    let corners = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
                    let [a, b, c, d] = corners;
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
        let mesh = ClayMesh::new(vertices, triangles)
            .ok_or_else(|| ClayError::UnknownStart("sheet".to_owned()))?;
        let start = Shaping::of(mesh, Space::default(), DETAIL);
        let coat = f64::from(radius);
        // 3 : 4 : 5, so that the way is one coating long.
        let to =
            [600.0 * coat, 0.0, 800.0 * coat].map(|thousandths| libm::round(thousandths) as i32);
        let clay = Clay {
            detail: DETAIL,
            tools: vec![ClayTool {
                shape: Some(ToolShape::Ball { radius }),
                coat,
            }],
            strokes: vec![stroke(&[[0; 3], to])],
            ..Clay::default()
        };
        Ok(Self { clay, start })
    }

    /// Seconds of a step, edges and normals included, and what all steps did.
    fn step(&self, clock: fn() -> f64) -> Result<(f64, Work), ClayError> {
        let mut shaping = self.start.clone();
        let start = clock();
        shaping.stroke(&self.clay, &mut |_| true)?;
        let seconds = clock() - start;
        let work = shaping.work().since(self.start.work());
        Ok((seconds / work.steps.max(1) as f64, work))
    }

    /// Seconds that it takes to evaluate the field at a vertex and to write it back, in the same steps of the sheet at
    /// rest.
    fn field(&self, clock: fn() -> f64) -> Result<f64, ClayError> {
        let Some(motion) = motion_of(&self.clay, (0, &self.clay.strokes[0])) else {
            return Err(ClayError::UnknownStart("stroke".to_owned()));
        };
        let positions = self.start.shaped().positions;
        let reached = |step: Step| {
            let near = |at: &u32| is_in(&step.balls, positions[*at as usize].as_dvec3());
            let near: Vec<u32> = (0..positions.len() as u32).filter(near).collect();
            (step, near)
        };
        let times = motion.times().unwrap_or_default().into_iter();
        let steps: Vec<(Step, Vec<u32>)> = times.map(|time| reached(motion.step(time))).collect();
        let mut fields = vec![0.0_f32; positions.len()];
        let start = clock();
        for (step, near) in &steps {
            for at in near {
                let pos = positions[*at as usize].as_dvec3();
                fields[*at as usize] = motion.field(step, pos) as f32;
            }
            black_box(&mut fields);
        }
        let seconds = clock() - start;
        let evaluated: usize = steps.iter().map(|(_, near)| near.len()).sum();
        Ok(seconds / evaluated.max(1) as f64)
    }
}

/// The tools of a stroke that moves; none if it is off, smooths, or is left out.
fn motion_of<'a>(clay: &'a Clay, of: (usize, &ClayStroke)) -> Option<Motion<'a>> {
    let (_, stroke) = of;
    if stroke.is_off || stroke.smooth.is_some() {
        return None;
    }
    let motion = Motion::new(clay, of, &Grids::default()).ok()?;
    motion.times().is_ok().then_some(motion)
}

/// Random strokes on a ball of the default detail.
struct Recipe {
    clay: Clay,
    start: Shaping,
    /// The fewest steps that its strokes may take.
    fewest: usize,
}

impl Recipe {
    fn new() -> Result<Self, ClayError> {
        let clay = Clay {
            strokes: random_strokes(),
            ..Clay::default()
        };
        let moving = clay.strokes.iter().enumerate();
        let moving = moving.filter_map(|of| motion_of(&clay, of));
        Ok(Self {
            fewest: moving.map(|motion| motion.fewest()).sum(),
            start: Shaping::new(&clay)?,
            clay,
        })
    }

    /// The strokes one by one, and the mesh after each as a picture takes it: seconds, and the most bytes of a vertex.
    fn live(&self, clock: fn() -> f64) -> Result<(f64, f64), ClayError> {
        let mut shaping = self.start.clone();
        let (mut seconds, mut bytes) = (0.0, 0.0_f64);
        for _ in &self.clay.strokes {
            let start = clock();
            shaping.stroke(&self.clay, &mut |_| true)?;
            black_box(shaping.shaped());
            seconds += clock() - start;
            bytes = bytes.max(shaping.bytes() as f64 / shaping.vertex_count() as f64);
        }
        Ok((seconds, bytes))
    }

    /// All strokes, and the mesh that they leave.
    fn replay(&self, clock: fn() -> f64) -> Result<(f64, Shaping), ClayError> {
        let mut shaping = self.start.clone();
        let start = clock();
        for _ in &self.clay.strokes {
            shaping.stroke(&self.clay, &mut |_| true)?;
        }
        black_box(shaping.shaped());
        Ok((clock() - start, shaping))
    }
}

/// A stroke of the first tool through some places, thousandths of a unit.
fn stroke(places: &[[i32; 3]]) -> ClayStroke {
    let key = |at: &[i32; 3]| ClayKey {
        at: *at,
        turn: [0; 3],
        percent: 100,
    };
    ClayStroke {
        moves: vec![ClayMove {
            tool: 0,
            keys: places.iter().map(key).collect(),
            is_straight: false,
        }],
        mirror: [false; 3],
        smooth: None,
        is_off: false,
    }
}

/// Strokes of two to four keys that begin at the surface of a ball: every third with turns, every fourth mirrored;
/// every eighth smooths.
fn random_strokes() -> Vec<ClayStroke> {
    let mut state = SEED;
    let mut draw = |most: i32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((state >> 8) % (2 * most + 1) as u32) as i32 - most
    };
    let mut strokes = Vec::new();
    for i in 0..STROKES {
        let out = Vec3::from_array([0; 3].map(|_| draw(1000) as f32)).normalize_or(Vec3::Z);
        let mut place = (460.0 * out).to_array().map(|x| x as i32);
        let mut places = vec![place];
        for _ in 0..1 + i % 3 {
            place = place.map(|x| x + draw(120));
            places.push(place);
        }
        let mut stroke = stroke(&places);
        if i % 3 == 1 {
            for key in &mut stroke.moves[0].keys[1..] {
                key.turn = [draw(40), draw(40), draw(40)];
            }
        }
        stroke.mirror[0] = i % 4 == 3;
        stroke.smooth = (i % 8 == 6).then_some(ClayStroke::DEFAULT_STRENGTH);
        strokes.push(stroke);
    }
    strokes
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use super::*;

    /// Seconds that pass whenever somebody asks.
    fn clock() -> f64 {
        static ASKED: AtomicU32 = AtomicU32::new(0);
        f64::from(ASKED.fetch_add(1, Ordering::Relaxed))
    }

    /// Counts, which are the same on every machine; of times only that there are some.
    #[test]
    fn what_can_be_counted_keeps_its_limits() {
        let bench = measured(clock, [1, 1]).unwrap();
        let [step, many, replay, steps, bytes] = &bench.limits[..] else {
            panic!("{bench}");
        };
        for timed in [step, many, replay] {
            assert!(timed.value > 0.0, "{bench}");
        }
        assert!(steps.holds() && steps.value >= 1.0, "{bench}");
        assert!(bytes.holds() && bytes.value > 100.0, "{bench}");
        assert!((18_000.0..23_000.0).contains(&bench.in_reach), "{bench}");
        let [few, many] = bench.sheet_triangles;
        assert!(few < 30_000 && many > 280_000, "{bench}");
        let work = bench.work;
        assert!(work.splits > 1000 && work.collapses > 100, "{bench}");
        assert!(bench.triangles > 45_000 && bench.strokes == STROKES);
    }
}
