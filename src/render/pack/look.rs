use super::gpu_types::{self, OPACITY_CONSTANCY, OPACITY_MASS, OPACITY_NONE};
use super::values::SubjectInfo;
use crate::document::{
    Background, Ghost, GhostBy, Light, Look, OpacityMode, Preset, PresetSubject, SubjectRef,
    Transfer, TransferPoint, Window, preset,
};
use crate::math::linear_from_srgb;
use glam::Vec3;
use half::f16;

/// Entries of the transfer table. 1,024 over a window of 2,000 Hounsfield units is one per two.
pub const TABLE_SIZE: usize = 1024;

/// The transfer function as the shader takes it.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferTable {
    /// Linear RGB and opacity of 0.01 subject units, 0 to 1.
    pub entries: Vec<[f32; 4]>,
    /// Value of the first and of the last entry.
    pub domain: [f32; 2],
    /// How much segments tint, 0 to 1.
    pub tint: f32,
    /// Strength of highlights, 0 to 1.
    pub specular: f32,
    /// How much opacity follows the steepness of the value, 0 to 1.
    pub gradient: f32,
    /// The part of its opacity that tissue keeps where it is a ghost, 0 to 1.
    pub ghost: f32,
    /// Where the light comes from and how it falls; `None`: as where a document says nothing of it.
    pub light: Option<Light>,
    /// The edges of a mesh's triangles are drawn.
    pub has_wires: bool,
}

/// Linear RGB from sRGB bytes.
pub fn linear_color(srgb: [u8; 3]) -> Vec3 {
    Vec3::from_array(srgb.map(linear_from_srgb))
}

/// Name of the preset that "auto" stands for.
pub fn auto_preset(subject: &SubjectRef, info: &SubjectInfo) -> &'static str {
    match subject {
        // Lungs are nearly air: they need a table of their own to be seen.
        SubjectRef::Builtin { name, .. } if info.has_segments && name == "torso" => {
            "tissue-and-lungs"
        }
        SubjectRef::Builtin { .. } if info.has_segments => "tissue",
        _ if info.is_ct => "ct-soft-tissue",
        _ => "mri",
    }
}

/// The window a preset is stretched over.
pub fn window_of(window: Window, preset: &Preset, info: &SubjectInfo) -> [f32; 2] {
    match (window, preset.window) {
        (Window::Range(range), _) => range,
        (Window::Auto, Some(range)) if info.is_ct || preset.subject == PresetSubject::Builtin => {
            range.map(|value| value + info.hounsfield_offset)
        }
        (Window::Auto, _) => info.window_auto,
    }
}

/// A preset's points at the values that they stand for in a window.
pub fn absolute_points(preset: &Preset, [low, high]: [f32; 2]) -> Vec<TransferPoint> {
    let points = preset.points.iter();
    points
        .map(|p| TransferPoint {
            value: low + p.value * (high - low),
            ..*p
        })
        .collect()
}

impl TransferTable {
    /// The table for a look on a subject. An unknown preset (kept in the document, named in a notice) counts as "auto".
    pub fn new(look: &Look, subject: &SubjectRef, info: &SubjectInfo) -> Self {
        let auto = || preset(auto_preset(subject, info));
        let named = match &look.transfer {
            Transfer::Auto => auto(),
            Transfer::Preset(name) => preset(name).or_else(auto),
            Transfer::Points(_) => None,
        };
        let table = match (&look.transfer, named) {
            (Transfer::Points(points), _) => {
                Self::from_points(points, look.tint.unwrap_or(0.0), 0.1)
            }
            (_, Some(preset)) => {
                let window = window_of(look.window, preset, info);
                let points = absolute_points(preset, window);
                Self::from_points(&points, look.tint.unwrap_or(preset.tint), preset.specular)
            }
            (_, None) => Self::from_points(&[], 0.0, 0.0),
        };
        Self {
            gradient: look.gradient,
            ghost: ghost_keeps(look.style.ghost),
            light: look.light,
            has_wires: look.has_wires,
            ..table
        }
    }

    /// The table for points sorted by value; the first and the last point hold for values beyond them. Without points
    /// nothing is seen.
    pub fn from_points(points: &[TransferPoint], tint: f32, specular: f32) -> Self {
        let low = points.first().map_or(0.0, |p| p.value);
        let high = points.last().map_or(1.0, |p| p.value);
        // A single point, or a step: a domain is needed that has a width; half of it lies before the step.
        let domain = if high > low {
            [low, high]
        } else {
            let width = (low.abs() * 1e-3).max(1e-3);
            [low - width, low + width]
        };
        let entries = (0..TABLE_SIZE)
            .map(|i| {
                let part = i as f32 / (TABLE_SIZE - 1) as f32;
                interpolate(points, domain[0] + part * (domain[1] - domain[0]))
            })
            .collect();
        Self {
            entries,
            domain,
            tint,
            specular,
            gradient: 0.0,
            ghost: 1.0,
            light: None,
            has_wires: false,
        }
    }

    /// The table as rgba16float texels.
    pub fn texels(&self) -> Vec<[u16; 4]> {
        self.entries
            .iter()
            .map(|entry| entry.map(|c| f16::from_f32(c).to_bits()))
            .collect()
    }

    /// Opacity (of 0.01 units) of a value, as the shader reads it.
    pub fn opacity(&self, value: f32) -> f32 {
        let [low, high] = self.domain;
        let at = ((value - low) / (high - low)).clamp(0.0, 1.0) * (TABLE_SIZE - 1) as f32;
        let i = (at as usize).min(TABLE_SIZE - 2);
        let part = at - i as f32;
        match (self.entries.get(i), self.entries.get(i + 1)) {
            (Some(a), Some(b)) => a[3] + (b[3] - a[3]) * part,
            _ => 0.0,
        }
    }

    /// The uniform: position in the table from a normalised texel.
    pub fn uniform(&self, mode: OpacityMode, info: &SubjectInfo) -> gpu_types::Look {
        let [low, high] = self.domain;
        let [value_low, value_high] = info.value_range;
        let range = if value_high > value_low {
            value_high - value_low
        } else {
            1.0
        };
        let n = TABLE_SIZE as f32;
        let per_value = (n - 1.0) / (high - low);
        gpu_types::Look {
            table_scale: per_value * range / n,
            table_offset: ((value_low - low) * per_value + 0.5) / n,
            tint: self.tint,
            specular: self.specular,
            opacity_mode: match mode {
                OpacityMode::Constancy => OPACITY_CONSTANCY,
                OpacityMode::Mass => OPACITY_MASS,
                OpacityMode::None => OPACITY_NONE,
            },
            edges: self.gradient,
            ghost: self.ghost,
            ..lit_by(self.light)
        }
    }
}

/// Towards the key light of a document that says nothing of light, view space: left and above, so that relief reads as
/// relief, since light from above is what eyes expect.
const KEY_DIR: Vec3 = Vec3::new(-0.5, 0.62, 0.604);
/// How far the key light wraps around: plaster would have 0, and under skin each colour goes its own way.
const KEY_WRAP: f32 = 0.18;
const SKIN_WRAP: Vec3 = Vec3::new(0.55, 0.2, 0.1);
/// How much of the key light something opaque takes near a surface and far from it; with a lamp of its own, near it,
/// and far from it for a small and for a large lamp.
const SHADE: [f32; 2] = [0.62, 0.3];
const LAMP_SHADE: [f32; 3] = [0.7, 0.65, 0.25];
/// How wide the softest lamp is, as a part of its distance.
const WIDEST_LAMP: f32 = 0.25;
/// How much of the light occlusion takes at a contact of 0.5.
const CONTACT: f32 = 0.8;

/// The light, in the members of the uniform that tell of it.
fn lit_by(light: Option<Light>) -> gpu_types::Look {
    let lit = |dir: Vec3, wrap: Vec3| gpu_types::Look {
        key_dir: dir.extend(0.0).to_array(),
        key_wrap: wrap.extend(0.0).to_array(),
        ..gpu_types::Look::default()
    };
    let Some(light) = light else {
        return gpu_types::Look {
            shade_near: SHADE[0],
            shade_far: SHADE[1],
            contact: CONTACT,
            ..lit(KEY_DIR, Vec3::splat(KEY_WRAP))
        };
    };
    let [near, far_small, far_large] = LAMP_SHADE;
    gpu_types::Look {
        lamp: WIDEST_LAMP * light.soft,
        shade_near: near,
        shade_far: far_small + (far_large - far_small) * light.soft,
        contact: (2.0 * CONTACT * light.contact).min(1.0),
        ..lit(light.from, KEY_WRAP + SKIN_WRAP * light.skin)
    }
}

/// The part of its opacity that tissue keeps as a ghost. Opacity counts for a hundredth of a subject unit, of which
/// there are many on a ray: half a ghost keeps an eighth.
fn ghost_keeps(ghost: Ghost) -> f32 {
    match ghost.by {
        GhostBy::Facing => (1.0 - ghost.strength).powi(3),
        GhostBy::Cut => 1.0,
    }
}

fn interpolate(points: &[TransferPoint], value: f32) -> [f32; 4] {
    let entry = |p: &TransferPoint| linear_color(p.color_srgb).extend(p.opacity);
    let after = points.partition_point(|p| p.value <= value);
    let found = match (
        after.checked_sub(1).and_then(|i| points.get(i)),
        points.get(after),
    ) {
        (Some(a), Some(b)) => {
            let part = (value - a.value) / (b.value - a.value).max(1e-12);
            entry(a).lerp(entry(b), part.clamp(0.0, 1.0))
        }
        (Some(p), None) | (None, Some(p)) => entry(p),
        (None, None) => glam::Vec4::ZERO,
    };
    found.to_array()
}

/// Background as the shader takes it: linear RGB, w 1 if there is one.
pub(crate) fn background_uniform(background: Background) -> [f32; 4] {
    match background {
        Background::None => [0.0; 4],
        Background::Color(srgb) => linear_color(srgb).extend(1.0).to_array(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(value: f32, color_srgb: [u8; 3], opacity: f32) -> TransferPoint {
        TransferPoint {
            value,
            color_srgb,
            opacity,
        }
    }

    #[test]
    fn colours_mix_in_linear_light() {
        let table = TransferTable::from_points(
            &[
                point(0.0, [0, 0, 0], 0.0),
                point(100.0, [255, 255, 255], 1.0),
            ],
            0.0,
            0.0,
        );
        assert!((table.opacity(50.0) - 0.5).abs() < 1e-3);
        let middle = table.entries[TABLE_SIZE / 2];
        assert!(
            (middle[0] - 0.5).abs() < 1e-3,
            "half the light, not half the byte"
        );
    }

    #[test]
    fn ends_go_on_and_steps_stay_sharp() {
        let table = TransferTable::from_points(
            &[
                point(0.0, [9; 3], 0.2),
                point(50.0, [9; 3], 0.2),
                point(50.0, [9; 3], 0.8),
                point(100.0, [9; 3], 0.8),
            ],
            0.0,
            0.0,
        );
        assert_eq!(table.opacity(-1e9), 0.2);
        assert_eq!(table.opacity(1e9), 0.8);
        assert!(table.opacity(49.0) < 0.21 && table.opacity(51.0) > 0.79);
    }

    #[test]
    fn no_points_show_nothing() {
        let table = TransferTable::from_points(&[], 0.0, 0.0);
        assert!(table.entries.iter().all(|e| e[3] <= 0.0));
    }
}
