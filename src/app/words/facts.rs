//! What is known of the scan that is shown.

words! {
    /// Names of the facts of a scan.
    Facts {
        about: "About this scan", "Über diesen Scan", "Acerca de este estudio", "关于此扫描";
        name: "Name", "Name", "Nombre", "名称";
        modality: "Modality", "Modalität", "Modalidad", "成像方式";
        ct: "CT", "CT", "TC", "CT";
        mr: "MRI", "MRT", "RM", "MRI";
        us: "Ultrasound", "Ultraschall", "Ecografía", "超声";
        voxels: "Voxels", "Voxel", "Vóxeles", "体素";
        spacing: "Spacing", "Abstand", "Espaciado", "间距";
        size: "Size", "Größe", "Tamaño", "尺寸";
        values: "Values", "Werte", "Valores", "数值";
        from_to: "{0} to {1}", "{0} bis {1}", "de {0} a {1}", "{0} 至 {1}";
        segments: "Segments", "Segmente", "Segmentos", "分割";
    }
}

/// What made the images of a scan, from DICOM's abbreviation; one that is not known here stays as it is.
pub(crate) fn modality(code: &str) -> &str {
    match code {
        "CT" => w().ct,
        "MR" => w().mr,
        "PT" => "PET",
        "US" => w().us,
        other => other,
    }
}
