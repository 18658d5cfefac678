//! What is wrong with a file that was opened, in the words of its owner.

use super::{fill, localized};
use crate::load::{FaultKind, FileFault};

words! {
    /// What is wrong with a file; `{0}` is its name.
    Faults {
        picture: "{0} is an image, not a scan", "{0} ist ein Bild, kein Scan", "{0} es una imagen, no un estudio", "{0} 是图片，不是扫描";
        surface: "{0} is a surface mesh, not a scan: save it as PLY or GLB and open it by itself", "{0} ist ein Oberflächennetz, kein Scan: bitte als PLY oder GLB speichern und für sich öffnen", "{0} es una malla de superficie, no un estudio: guárdela como PLY o GLB y ábrala por separado", "{0} 是表面网格，不是扫描：请存为 PLY 或 GLB 后单独打开";
        archive: "{0} is an archive: unpack it and open the scan in it", "{0} ist ein Archiv: bitte entpacken und den Scan darin öffnen", "{0} es un archivo comprimido: descomprímalo y abra el estudio que contiene", "{0} 是压缩包：请解压后打开其中的扫描";
        unknown: "{0} is not a scan that Fabrica can read: it reads NIfTI, NRRD, MetaImage and DICOM", "{0} ist kein Scan, den Fabrica lesen kann: gelesen werden NIfTI, NRRD, MetaImage und DICOM", "Fabrica no puede leer {0}: lee estudios NIfTI, NRRD, MetaImage y DICOM", "{0} 不是 Fabrica 能读取的扫描：可读取 NIfTI、NRRD、MetaImage 和 DICOM";
        empty: "{0} is empty: get it again", "{0} ist leer: bitte neu beschaffen", "{0} está vacío: vuelva a obtenerlo", "{0} 是空文件：请重新获取";
        cut_short: "The file is cut short ({0} of {1}): get it again", "Die Datei ist abgeschnitten ({0} von {1}): bitte neu beschaffen", "El archivo está cortado ({0} de {1}): vuelva a obtenerlo", "文件不完整（只有 {0}，应为 {1}）：请重新获取";
        damaged: "{0} is damaged or cut short: get it again", "{0} ist beschädigt oder abgeschnitten: bitte neu beschaffen", "{0} está dañado o cortado: vuelva a obtenerlo", "{0} 已损坏或不完整：请重新获取";
        unreadable: "{0} could not be read", "{0} konnte nicht gelesen werden", "No se pudo leer {0}", "无法读取 {0}";
        lacks: "{1} goes with {0}: open both together", "{1} gehört zu {0}: bitte beide zusammen öffnen", "{1} va con {0}: abra los dos juntos", "{0} 需要 {1}：请一起打开";
        header: "The header of {0} is faulty: get the file again, or save it anew where it comes from", "Der Dateikopf von {0} ist fehlerhaft: bitte neu beschaffen oder dort neu sichern, wo die Datei herkommt", "La cabecera de {0} es errónea: vuelva a obtener el archivo o guárdelo de nuevo en su origen", "{0} 的文件头有误：请重新获取，或在来源处重新保存";
        too_large: "{0} holds more voxels than can be opened", "{0} hat mehr Voxel, als geöffnet werden können", "{0} tiene más vóxeles de los que se pueden abrir", "{0} 的体素数超出可打开的范围";
    }
}

/// What is wrong with a file, in one line.
pub(crate) fn text(fault: &FileFault) -> String {
    let w = w();
    let line = match fault.kind {
        FaultKind::Picture => w.picture,
        FaultKind::Surface => w.surface,
        FaultKind::Archive => w.archive,
        FaultKind::Unknown => w.unknown,
        FaultKind::Empty => w.empty,
        FaultKind::CutShort => return cut_short(fault.bytes),
        FaultKind::Damaged => w.damaged,
        FaultKind::Unreadable => w.unreadable,
        FaultKind::Lacks => w.lacks,
        FaultKind::Header => w.header,
        FaultKind::TooLarge => w.too_large,
    };
    fill(line, &[&fault.name, &fault.needed])
}

/// How much of a file is there, in the unit in which the whole is a handy number.
fn cut_short([found, expected]: [u64; 2]) -> String {
    let (unit, decimals, name) = match expected {
        0..1_000 => (1.0, 0, "bytes"),
        1_000..1_000_000 => (1e3, 1, "kB"),
        1_000_000..1_000_000_000 => (1e6, 1, "MB"),
        _ => (1e9, 2, "GB"),
    };
    let number = |bytes: u64| localized(format!("{:.decimals$}", bytes as f64 / unit));
    let whole = format!("{} {name}", number(expected));
    fill(w().cut_short, &[&number(found), &whole])
}

#[cfg(test)]
mod tests {
    use super::super::{Lang, set_lang};
    use super::*;

    #[test]
    fn a_file_that_is_cut_short_says_how_much_is_there() {
        let fault = FileFault {
            kind: FaultKind::CutShort,
            name: "scan.nii".to_owned(),
            bytes: [1_200_000, 3_400_000],
            needed: String::new(),
        };
        let english = "The file is cut short (1.2 of 3.4 MB): get it again";
        assert_eq!(text(&fault), english);
        set_lang(Lang::German);
        assert!(text(&fault).contains("(1,2 von 3,4 MB)"));
        set_lang(Lang::English);
        assert!(cut_short([3, 8]).contains("3 of 8 bytes"));
    }
}
