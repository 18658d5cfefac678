//! Pictures on meshes: packed ones as the readers find them, unpacked ones that fit.

use super::report::Aside;
use crate::data::{Mesh, MeshTexture, Wrap};
use crate::pictures::{Picture, PictureError, PictureHeader, halved};

/// Pixels along a side of a texture at most; larger ones are halved.
const MAX_SIDE: u32 = 4096;
/// Bytes of all textures of a subject at most, reduced copies apart.
const MAX_BYTES: u64 = 64 << 20;

/// A texture from the bytes of a file, still packed.
///
/// # Errors
/// [`PictureError`], by the header.
pub(super) fn texture(packed: Vec<u8>, wrap: [Wrap; 2]) -> Result<MeshTexture, PictureError> {
    let size = PictureHeader::of(&packed)?.size;
    Ok(MeshTexture {
        packed,
        size,
        wrap,
        picture: None,
    })
}

/// Takes the packed pictures that triangles of a mesh use out of it, with the index of the texture of each.
pub(super) fn take_packed(mesh: &mut Mesh) -> Vec<(usize, Vec<u8>)> {
    let mut is_used = vec![false; mesh.textures.len()];
    for triangle in 0..mesh.triangles.len() {
        if let Some(used) = mesh.texture_of(triangle).and_then(|of| is_used.get_mut(of)) {
            *used = true;
        }
    }
    let all = mesh.textures.iter_mut().zip(is_used).enumerate();
    all.filter(|(_, (_, is_used))| *is_used)
        .map(|(index, (texture, _))| (index, std::mem::take(&mut texture.packed)))
        .collect()
}

/// Halves pictures until no side is too long and all of them together fit, the largest first.
pub(super) fn fit(pictures: &mut [&mut Picture]) {
    loop {
        let total: u64 = pictures.iter().map(|picture| picture.byte_len()).sum();
        let is_too_long = |picture: &Picture| picture.size[0].max(picture.size[1]) > MAX_SIDE;
        let too_long = pictures.iter().position(|picture| is_too_long(picture));
        let largest = || {
            let all = (0..pictures.len()).rev();
            all.max_by_key(|&index| pictures[index].byte_len())
        };
        let next = too_long.or_else(|| largest().filter(|_| total > MAX_BYTES));
        let Some(next) = next.filter(|&next| pictures[next].size != [1, 1]) else {
            return;
        };
        let smaller = halved(pictures[next]);
        *pictures[next] = smaller;
    }
}

/// What the user should know of a texture that has been unpacked: that it is of inks, or smaller than its file says.
pub(super) fn notices(texture: &MeshTexture) -> Vec<Aside> {
    let Some(picture) = &texture.picture else {
        return Vec::new();
    };
    let reduced = Aside::Reduced {
        from: texture.size,
        to: picture.size,
    };
    let all = [
        (picture.is_of_inks, Aside::Inks),
        (picture.size != texture.size, reduced),
    ];
    let told = all.into_iter().filter(|(is_so, _)| *is_so);
    told.map(|(_, notice)| notice).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(size: [u32; 2]) -> MeshTexture {
        let picture = Picture {
            size,
            pixels: vec![[9, 9, 9, 255]; (size[0] * size[1]) as usize],
            is_of_inks: false,
        };
        MeshTexture {
            packed: Vec::new(),
            size,
            wrap: [Wrap::Repeat; 2],
            picture: Some(picture),
        }
    }

    fn fitted<const N: usize>(sizes: [[u32; 2]; N]) -> [MeshTexture; N] {
        let mut all = sizes.map(texture);
        let mut pictures: Vec<&mut Picture> = all
            .iter_mut()
            .filter_map(|texture| texture.picture.as_mut())
            .collect();
        fit(&mut pictures);
        all
    }

    #[test]
    fn pictures_are_halved_until_they_fit() {
        let all = fitted([[4096, 4096], [5000, 2], [64, 64]]);
        let sizes = all
            .each_ref()
            .map(|of| of.picture.as_ref().expect("it is there").size);
        assert_eq!(sizes, [[2048, 2048], [2500, 1], [64, 64]]);
        let told: Vec<String> = all
            .iter()
            .flat_map(notices)
            .map(|n| n.to_string())
            .collect();
        assert_eq!(told.len(), 2, "{told:?}");
        assert!(
            told[0].contains("4096 × 4096") && told[0].contains("2048 × 2048"),
            "{told:?}"
        );
        let [most] = fitted([[4096, 4096]]);
        assert!(notices(&most).is_empty(), "64 MiB are not too much");
    }
}
