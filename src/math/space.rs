//! The spaces, by the names used in Rust and WGSL alike. Transforms are called `a_from_b`,
//! points `pos_in_a` (or `pos` where one space is meant throughout), directions `dir_in_a`.
//!
//! | space | what | unit |
//! |---|---|---|
//! | `voxel` | index into the grid, the centre of the first voxel at 0 | voxels |
//! | `texture` | the same grid, outer edges at 0 and 1 | 1 |
//! | `world` | the scanner's space, RAS+ | mm |
//! | `subject` | origin in the middle of the subject's box, axes as `world`; deformed, as shown | longest side of it |
//! | `rest` | subject space before any template acted: where a sample came from | as `subject` |
//! | `template` | unit cube of one placed template | 1 |
//! | `view` | camera at the origin, looking along -z, y up | as `subject` |
//! | `clip` | after projection, WebGPU's convention (depth 0 to 1) | 1 |
//! | `pixel` | of the picture, origin top left | device pixels |
//! | `ui` | of the window, origin top left | points |
