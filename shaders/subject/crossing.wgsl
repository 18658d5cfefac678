// The triangles that a line meets, as the document has the bodies of a mesh.
// needs: types.wgsl bind/subject.wgsl bind/mesh_look.wgsl subject/mesh.wgsl

/// True for the triangles of the file, and for those of a lid where the body is full or, if it is said, a shell.
fn is_seen(triangle: u32, sees_shells: bool) -> bool {
    let owner = owner_of(triangle);
    let kind = mesh_look.segments[owner & ~LID].kind;
    return owner < LID || kind == BODY_FULL || (sees_shells && kind == BODY_THICK);
}

/// The first triangle on the way from a place to another, `skipped` left out and lids of bodies that are not full.
/// `sees_shells`: lids of shells are taken too, at whose rim alone there is something.
fn first_crossing(start: vec3f, end: vec3f, skipped: u32, sees_shells: bool) -> TriangleCrossing {
    let way = end - start;
    let inverse_way = inverse_of(way);
    var found = TriangleCrossing(NO_TRIANGLE, 1.0, vec3f(0.0), false);
    let root = mesh_root();
    var index = 0u;
    while index < subject.node_count {
        // On to the next leaf that is met: nodes and triangles are tested in loops of their own, since processors that
        // run several rays at once go through the tests of both wherever one loop holds them.
        var left = 0u;
        var triangle = 0u;
        while left == 0u && index < subject.node_count {
            let node = mesh_node(index, root);
            let span = part_in_box(start, inverse_way, node.low, node.high, found.part);
            let is_met = span.x <= span.y;
            left = select(0u, node.count, is_met);
            triangle = node.first;
            index = select(node.skip, index + 1u, is_met);
        }
        while left > 0u {
            left--;
            let crossing = crossing_of(triangle, start, way);
            if crossing.triangle != NO_TRIANGLE && crossing.triangle != skipped && crossing.part <= found.part {
                if is_seen(triangle, sees_shells) {
                    found = crossing;
                }
            }
            triangle++;
        }
    }
    return found;
}
