//! The pieces of a picture: what hangs together of what is drawn. It needs nothing of the other commands, so that the
//! tests hold it too.

/// Alpha of a pixel that counts as drawn: above this of 255.
pub(crate) const SEEN_ALPHA: u8 = 96;

/// The pieces of a picture with nothing behind it, the largest first. `rgba`: rows of `width` pixels from the top, four
/// bytes each. A piece is a list of pixels (column and row, from 0) that hang together by sides and corners, each with
/// an alpha above [`SEEN_ALPHA`].
pub(crate) fn pieces(width: u32, rgba: &[u8]) -> Vec<Vec<(u32, u32)>> {
    let (pixels, _) = rgba.as_chunks::<4>();
    let mut is_open: Vec<bool> = pixels.iter().map(|p| p[3] > SEEN_ALPHA).collect();
    let height = is_open.len() as u32 / width.max(1);
    let mut pieces = Vec::new();
    for start in 0..is_open.len() {
        let mut piece = Vec::new();
        let mut next = vec![start];
        while let Some(at) = next.pop() {
            if !std::mem::take(&mut is_open[at]) {
                continue;
            }
            let (x, y) = (at as u32 % width, at as u32 / width);
            piece.push((x, y));
            for row in y.saturating_sub(1)..(y + 2).min(height) {
                let columns = x.saturating_sub(1)..(x + 2).min(width);
                next.extend(columns.map(|column| (row * width + column) as usize));
            }
        }
        if !piece.is_empty() {
            pieces.push(piece);
        }
    }
    pieces.sort_by_key(|piece| std::cmp::Reverse(piece.len()));
    pieces
}

/// What lies beside the largest piece and has fewer pixels than `least`.
#[allow(dead_code, reason = "each test uses a part of this file")]
pub(crate) fn islands(mut pieces: Vec<Vec<(u32, u32)>>, least: usize) -> Vec<Vec<(u32, u32)>> {
    let beside = pieces.split_off(pieces.len().min(1));
    let small = beside.into_iter().filter(|piece| piece.len() < least);
    small.collect()
}
