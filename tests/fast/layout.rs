//! The structs of `shaders/types.wgsl` and those of `render::gpu_types` agree by name, order, offset and size.

use fabrica::data::Resources;
use fabrica::document::Document;
use fabrica::render::gpu_types;
use fabrica::render::programs;
use serde_json::json;
use std::collections::BTreeMap;
use wgpu::naga;

/// Name and byte offset of each member, in order, and the size of the whole.
#[derive(Clone, Debug, PartialEq)]
struct Layout {
    members: Vec<(String, usize)>,
    size: usize,
}

macro_rules! layouts {
    ($($name:ident { $($member:ident),* $(,)? })*) => {
        BTreeMap::from([
            $((
                stringify!($name).to_owned(),
                Layout {
                    members: vec![
                        $((stringify!($member).to_owned(), std::mem::offset_of!(gpu_types::$name, $member))),*
                    ],
                    size: size_of::<gpu_types::$name>(),
                },
            )),*
        ])
    };
}

fn rust_layouts() -> BTreeMap<String, Layout> {
    layouts! {
        Affine { row0, row1, row2 }
        Template {
            template_from_subject, subject_from_template, size, params0, params1, kind, group, curve, held,
        }
        Templates { items, count, pool }
        Frame {
            subject_from_view, lens, size_px, jitter, first_step, occlusion_turn, bounds_min, bounds_max, step,
            first_row, is_finished,
        }
        AskedRays { items }
        Subject {
            texture_from_rest, label_from_rest, dims, label_dims, texture_end,
            value_low, value_range, detail, has_labels,
            field_from_rest, fill_from_rest, field_dims, fill_dims,
            mesh_min, mesh_max, node_count, triangles_at, sets_at, textures_at, field_detail, labels_before,
        }
        MeshSegment { color, inside, kind, thickness, gloss, opacity, first_layer, layer_count }
        MeshLayer { color, depth, grain }
        MeshLook { segments, layers, has_filled }
        SceneObject { object_from_subject, color, inside, opacity, gloss, nodes_at, triangles_at, node_count, textures_at }
        SceneObjects { items, count }
        Look {
            key_dir, key_wrap, table_scale, table_offset, tint, specular, opacity_mode, edges, ghost, lamp, shade_near,
            shade_far, contact,
        }
        Grid { origin_min, cell_size, cells, is_used }
        Baked { origin_min, per_unit, texels, map_step, first_slab }
        Style {
            outline_color, warm, cool, hatch_color, stipple_color, axes, outline_px, crease_cosine, levels, tone,
            hatch_spacing_px, hatch_width_px, hatch, hatch_by, stipple_spacing_px, stipple_size_px, stipple, vignette,
            detail, first_row,
        }
        Resolve { scale, end, background, is_straight, is_unlit }
        Sheet { half_size, texels, viewport, levels }
        Slice {
            subject_from_pixel, background, grey_scale, grey_offset, mode, samples, marked_color, marked_strength,
            marked_from, marked_to,
        }
        Lattice { corner, cells, side, count, dispatch }
        KeptGroup { keeps, run, gives_way_to, constraint, depth, blend, longest, before, aligned }
        Kept {
            distance_from_rest, distance_dims, distance_slack, spacing, slab_count, exact_slab, depth_slab, parts,
            is_coarse, shared_sets, shares_add, rim, label_sets, items, motions, seams,
        }
        DistanceJob {
            volume_from_voxel, fine, coarse, spacing, ratio, label_from_voxel, rest_from_voxel, half_box, half_ball,
            channel, threshold, reads_labels,
            first_slice, slice_count, axis, slab, set_count, part, part_count, member_words, are_members_told,
            label_sets,
        }
        SharesJob {
            dims, words, set_index, channels, row_words, first_slice, slice_count, axis,
            label_sets,
        }
        Bodies { items }
        GridTemplate {
            reach0_min, reach0_max, reach1_min, reach1_max, own_min, own_max, shift_min, shift_max,
            detail, stretch, longest, material, is_torn, parts,
        }
        GridJob { origin_min, cell_size, cells, brick_from_rest, bricks, margin, farthest, spread, items }
    }
}

fn wgsl_module(source: &str) -> naga::Module {
    naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)))
}

fn wgsl_layouts(module: &naga::Module) -> BTreeMap<String, Layout> {
    module
        .types
        .iter()
        .filter_map(|(_, ty)| {
            let naga::TypeInner::Struct { members, span } = &ty.inner else {
                return None;
            };
            let members = members
                .iter()
                .map(|m| (m.name.clone().unwrap_or_default(), m.offset as usize))
                .collect();
            Some((
                ty.name.clone()?,
                Layout {
                    members,
                    size: *span as usize,
                },
            ))
        })
        .collect()
}

/// The shared structs with the file of affine maps, which they need.
fn types_source() -> String {
    let source = |path| programs::file(path).expect("it is embedded").source;
    source("affine.wgsl").to_owned() + source("types.wgsl")
}

#[test]
fn structs_agree_by_name_and_offset() {
    let (rust, wgsl) = (rust_layouts(), wgsl_layouts(&wgsl_module(&types_source())));
    for (name, layout) in &wgsl {
        let ours = rust
            .get(name)
            .unwrap_or_else(|| panic!("{name} of types.wgsl has no twin in this test"));
        assert_eq!(ours, layout, "struct {name}: Rust left, WGSL right");
    }
    assert_eq!(
        rust.keys().collect::<Vec<_>>(),
        wgsl.keys().collect::<Vec<_>>(),
        "structs on the Rust side only"
    );
}

/// Negative control: the comparison sees a member that was moved, and one that was renamed.
#[test]
fn a_moved_or_renamed_member_is_seen() {
    let rust = rust_layouts();
    for (from, to) in [
        (
            "    /// Index of the composing template",
            "    extra: u32,\n    /// Index of the composing template",
        ),
        ("    lens: vec2f", "    lense: vec2f"),
    ] {
        let source = types_source().replace(from, to);
        assert_ne!(source, types_source(), "the planted error is in");
        assert_ne!(
            wgsl_layouts(&wgsl_module(&source)),
            rust,
            "{to} was not noticed"
        );
    }
}

#[test]
fn constants_agree() {
    let module = wgsl_module(&types_source());
    let expected = BTreeMap::from([
        ("MAX_TEMPLATES", gpu_types::MAX_TEMPLATES as u32),
        ("OPACITY_CONSTANCY", gpu_types::OPACITY_CONSTANCY),
        ("OPACITY_MASS", gpu_types::OPACITY_MASS),
        ("OPACITY_NONE", gpu_types::OPACITY_NONE),
        ("HATCH_CURVATURE", gpu_types::HATCH_CURVATURE),
        ("HATCH_AXIS", gpu_types::HATCH_AXIS),
        ("SLICE_GREY", gpu_types::SLICE_GREY),
        ("SLICE_COLORS", gpu_types::SLICE_COLORS),
        ("SLICE_MARKED", gpu_types::SLICE_MARKED),
        ("BODY_HOLLOW", gpu_types::BODY_HOLLOW),
        ("BODY_THICK", gpu_types::BODY_THICK),
        ("BODY_FULL", gpu_types::BODY_FULL),
        ("BODY_BRICK", gpu_types::BODY_BRICK),
        ("BODY_ROW", gpu_types::BODY_ROW),
        ("BODY_MIXED", gpu_types::BODY_MIXED),
        ("BODY_NOTHING", gpu_types::BODY_NOTHING),
        ("KEEPS_DEEP", gpu_types::KEEPS_DEEP),
        ("MATERIAL_SHIFTED", gpu_types::MATERIAL_SHIFTED),
        ("MATERIAL_WITHIN", gpu_types::MATERIAL_WITHIN),
        ("MATERIAL_BENT", gpu_types::MATERIAL_BENT),
        ("MATERIAL_RIPPLED", gpu_types::MATERIAL_RIPPLED),
        ("CONSTRAIN_NOTHING", gpu_types::CONSTRAIN_NOTHING),
        ("CONSTRAIN_DISPLACEMENT", gpu_types::CONSTRAIN_DISPLACEMENT),
        ("CONSTRAIN_COORDINATE", gpu_types::CONSTRAIN_COORDINATE),
        ("CONSTRAIN_RIGID", gpu_types::CONSTRAIN_RIGID),
        ("CONSTRAIN_LATE", gpu_types::CONSTRAIN_LATE),
        ("CONSTRAIN_MANY", gpu_types::CONSTRAIN_MANY),
    ]);
    let bodies = BTreeMap::from([
        ("BODY_LAYER", gpu_types::BODY_LAYER),
        ("BODY_SOLID", gpu_types::BODY_SOLID),
        ("BODY_HIDDEN", gpu_types::BODY_HIDDEN),
    ]);
    let (mut found, mut numbers) = (BTreeMap::new(), BTreeMap::new());
    for (_, constant) in module.constants.iter() {
        let value = &module.global_expressions[constant.init];
        if let (Some(name), naga::Expression::Literal(naga::Literal::U32(value))) =
            (constant.name.as_deref(), value)
        {
            found.insert(name, *value);
        }
        if let (Some(name), naga::Expression::Literal(naga::Literal::F32(value))) =
            (constant.name.as_deref(), value)
        {
            numbers.insert(name, *value);
        }
    }
    assert_eq!(found, expected);
    assert_eq!(numbers, bodies);
}

/// As many sweeps as a document may have, of as many tools, each by itself with its image, along curves of as many
/// points: there is room for what all of them hold.
#[test]
fn the_pool_has_room_for_all_templates() {
    let tools: Vec<_> = [0.2, 0.4, 0.6, 0.8]
        .iter()
        .map(|y| json!({ "radius": 0.02, "coat": 0.02, "path": [[0.2, y, 0.5], [0.25, y, 0.5]] }))
        .collect();
    let curve: Vec<_> = (0..9)
        .map(|i| [0.1 * f64::from(i) + 0.1, 0.5 + 0.01 * f64::from(i)])
        .collect();
    let sweep = json!({ "kind": "sweep", "curve": { "points": curve }, "params": { "mirror": "x", "tools": tools } });
    let count = gpu_types::MAX_TEMPLATES;
    let document = json!({ "fabrica": 1, "templates": vec![sweep; count] });
    let document = Document::from_value(document).expect("a document");
    assert_eq!(document.notices(), []);
    let templates = &document.illustration().templates;
    let packed = gpu_types::Templates::pack(templates, &Resources::default());
    assert_eq!(packed.count as usize, count);
    for (i, template) in packed.items.iter().enumerate() {
        assert!(template.curve > 0, "the curve of {i}");
        assert!(template.held > 0, "the tools of {i}");
        let copies = packed.pool[template.held as usize][0];
        assert_eq!(copies, 8.0, "each tool of {i} is alone, on either side");
    }
}
