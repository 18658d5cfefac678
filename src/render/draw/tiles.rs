/// Side of the squares a picture is drawn in, pixels: short enough that a weak GPU answers in time.
pub(crate) const TILE: u32 = 64;

/// Tiles (x, y, width, height) that cover a picture, from its middle outwards, since people look at the middle first.
pub(crate) fn tiles_of(size: [u32; 2]) -> Vec<[u32; 4]> {
    let mut tiles = Vec::new();
    for y in (0..size[1]).step_by(TILE as usize) {
        for x in (0..size[0]).step_by(TILE as usize) {
            tiles.push([x, y, TILE.min(size[0] - x), TILE.min(size[1] - y)]);
        }
    }
    let [width, height] = size;
    tiles.sort_by_key(|&[x, y, w, h]| {
        let dx = i64::from(2 * x + w) - i64::from(width);
        let dy = i64::from(2 * y + h) - i64::from(height);
        dx * dx + dy * dy
    });
    tiles
}
