//! The named looks that a document's `look.transfer` may name.

use super::look::TransferPoint;

/// A named look: points relative to a window, and how it is lit.
#[derive(Debug)]
pub struct Preset {
    /// As written in documents.
    pub name: &'static str,
    /// English name that the interface shows.
    pub title: &'static str,
    /// The kind of values that the preset is made for.
    pub subject: PresetSubject,
    /// Window in the subject's own values if the document says "auto"; `None`: from the histogram.
    pub window: Option<[f32; 2]>,
    /// Opacity and colour over the position in the window, sorted; the ends go on.
    pub points: &'static [TransferPoint],
    /// How much the segments' own colours tint it, 0 to 1. The table's colour is multiplied in.
    pub tint: f32,
    /// Strength of highlights, 0 to 1.
    pub specular: f32,
}

/// What a preset is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PresetSubject {
    /// Built-in subjects with named segments in CT-like values.
    Builtin,
    /// Computed tomography in Hounsfield units.
    Ct,
    /// Magnetic resonance: no unit.
    Mri,
}

const fn at(value: f32, color: u32, opacity: f32) -> TransferPoint {
    TransferPoint {
        value,
        color_srgb: [(color >> 16) as u8, (color >> 8) as u8, color as u8],
        opacity,
    }
}

/// Every preset, in the order in which they are offered. Names and meanings never change; new ones are added.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "tissue",
        title: "Tissue",
        subject: PresetSubject::Builtin,
        window: Some([-1000.0, 1400.0]),
        points: &[
            at(0.000, 0xffffff, 0.0),
            at(0.250, 0xffffff, 0.0),
            at(0.290, 0xffffff, 1.0),
            at(0.450, 0xffffff, 1.0),
            at(1.000, 0xffffff, 1.0),
        ],
        tint: 1.0,
        specular: 0.10,
    },
    Preset {
        name: "tissue-and-lungs",
        title: "Tissue and lungs",
        subject: PresetSubject::Builtin,
        window: Some([-1000.0, 1400.0]),
        points: &[
            at(0.000, 0xffffff, 0.0),
            at(0.070, 0xffffff, 0.0),
            at(0.120, 0xffffff, 1.0),
            at(0.450, 0xffffff, 1.0),
            at(1.000, 0xffffff, 1.0),
        ],
        tint: 1.0,
        specular: 0.10,
    },
    Preset {
        name: "ct-soft-tissue",
        title: "CT soft tissue",
        subject: PresetSubject::Ct,
        window: Some([-1000.0, 1000.0]),
        points: &[
            at(0.000, 0xd8a283, 0.0),
            at(0.290, 0xd8a283, 0.0),
            at(0.345, 0xdcaa8a, 1.0),
            at(0.440, 0xe6c08a, 1.0),
            at(0.480, 0xd9a07c, 1.0),
            at(0.515, 0xb5584a, 1.0),
            at(0.545, 0xa84a40, 1.0),
            at(0.590, 0xc98a6a, 1.0),
            at(0.640, 0xeee0c2, 1.0),
            at(1.000, 0xfffaee, 1.0),
        ],
        tint: 0.0,
        specular: 0.10,
    },
    Preset {
        name: "ct-skin",
        title: "CT skin",
        subject: PresetSubject::Ct,
        window: Some([-1000.0, 1000.0]),
        points: &[
            at(0.000, 0xd9a384, 0.0),
            at(0.270, 0xd9a384, 0.0),
            at(0.330, 0xdcab8c, 1.0),
            at(0.600, 0xe0b191, 1.0),
            at(1.000, 0xf2ddc6, 1.0),
        ],
        tint: 0.0,
        specular: 0.12,
    },
    Preset {
        name: "ct-bone",
        title: "CT bone",
        subject: PresetSubject::Ct,
        window: Some([-1000.0, 1000.0]),
        points: &[
            at(0.000, 0xd8c8a4, 0.0),
            at(0.580, 0xd6bf97, 0.0),
            at(0.640, 0xe5d6b4, 1.0),
            at(0.800, 0xf0e6cd, 1.0),
            at(1.000, 0xf8f2e2, 1.0),
        ],
        tint: 0.0,
        specular: 0.16,
    },
    Preset {
        name: "ct-muscle-bone",
        title: "CT muscle and bone",
        subject: PresetSubject::Ct,
        window: Some([-1000.0, 1000.0]),
        points: &[
            at(0.000, 0x9c3f36, 0.0),
            at(0.490, 0x9c3f36, 0.0),
            at(0.520, 0xa4463b, 0.85),
            at(0.550, 0xa84a3e, 1.0),
            at(0.590, 0xc08664, 1.0),
            at(0.640, 0xeadbb9, 1.0),
            at(1.000, 0xfaf4e6, 1.0),
        ],
        tint: 0.0,
        specular: 0.14,
    },
    Preset {
        name: "ct-skin-glass",
        title: "CT skin as glass, bone",
        subject: PresetSubject::Ct,
        window: Some([-1000.0, 1000.0]),
        points: &[
            at(0.000, 0xe6b79c, 0.0),
            at(0.280, 0xe6b79c, 0.0),
            at(0.350, 0xe2ad90, 0.085),
            at(0.440, 0xd98c70, 0.015),
            at(0.560, 0xb85a48, 0.020),
            at(0.590, 0xd6bf97, 0.08),
            at(0.640, 0xe9dcbc, 1.0),
            at(1.000, 0xf9f3e4, 1.0),
        ],
        tint: 0.0,
        specular: 0.14,
    },
    Preset {
        name: "mri",
        title: "MRI",
        subject: PresetSubject::Mri,
        window: None,
        points: &[
            at(0.000, 0x6b4a40, 0.0),
            at(0.120, 0x8a5f50, 0.0),
            at(0.200, 0xa87562, 0.9),
            at(0.400, 0xc79a82, 1.0),
            at(0.650, 0xdcbba2, 1.0),
            at(1.000, 0xf4e9dc, 1.0),
        ],
        tint: 0.0,
        specular: 0.08,
    },
    Preset {
        name: "mri-glass",
        title: "MRI, faint",
        subject: PresetSubject::Mri,
        window: None,
        points: &[
            at(0.000, 0x6d7f96, 0.0),
            at(0.150, 0x7d8ca0, 0.0),
            at(0.350, 0xb09a90, 0.05),
            at(0.600, 0xd8b8a0, 0.16),
            at(1.000, 0xfff2e4, 0.5),
        ],
        tint: 0.0,
        specular: 0.05,
    },
];

/// All presets that a document may name.
pub fn presets() -> &'static [Preset] {
    PRESETS
}

/// The preset of a name.
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_sorted_and_names_are_unique() {
        for (i, preset) in PRESETS.iter().enumerate() {
            assert!(
                preset.points.is_sorted_by(|a, b| a.value <= b.value),
                "{}",
                preset.name
            );
            assert!(preset.points.len() >= 2, "{}", preset.name);
            assert!(
                PRESETS[i + 1..]
                    .iter()
                    .all(|other| other.name != preset.name)
            );
        }
    }
}
