//! What a file leaves open: which of its volumes, and how bare voxels lie.

words! {
    /// The choice of a volume in a file, and how bare voxels lie.
    Files {
        volume_of: "Volume {0} of {1}…", "Volumen {0} von {1} …", "Volumen {0} de {1}…", "第 {0} 个体数据，共 {1} 个…";
        volumes: "{0} volumes in this file", "{0} Volumen in dieser Datei", "{0} volúmenes en este archivo", "此文件含 {0} 个体数据";
        close_volumes: "Close the choice of volume", "Volumenauswahl schließen", "Cerrar la elección de volumen", "关闭体数据选择";
        volumes_hint: "Time points, or parts of one scan. The document keeps which one it shows.", "Zeitpunkte oder Teile eines Scans. Das Dokument merkt sich, welches Volumen es zeigt.", "Instantes o partes de un estudio. El documento guarda cuál muestra.", "时间点，或一次扫描的各部分。文档会记住显示的是哪一个。";
        volume: "Volume", "Volumen", "Volumen", "体数据";
        bare: "Raw voxels", "Rohe Voxel", "Vóxeles sin cabecera", "原始体素数据";
        bare_hint: "This file does not say how its voxels lie. Where it comes from, that is written down; a wrong size shows as a slanted picture.", "Diese Datei sagt nicht, wie ihre Voxel liegen. Wo sie herkommt, steht es geschrieben; eine falsche Größe zeigt sich als schräges Bild.", "Este archivo no dice cómo están dispuestos sus vóxeles. Consta en el lugar de donde procede; un tamaño erróneo se ve como una imagen inclinada.", "此文件没有说明体素的排列方式，其来源处会有记载；尺寸有误时图像会倾斜。";
        voxels: "Voxels", "Voxel", "Vóxeles", "体素数";
        width: "Width", "Breite", "Anchura", "宽";
        height: "Height", "Höhe", "Altura", "高";
        depth: "Depth", "Tiefe", "Profundidad", "深";
        kind: "Type", "Typ", "Tipo", "类型";
        high_byte_first: "High byte first", "Höheres Byte zuerst", "Byte alto primero", "高位字节在前";
        skip: "Bytes to skip", "Bytes überspringen", "Bytes que omitir", "跳过的字节数";
        voxel_size: "Voxel size, mm", "Voxelgröße, mm", "Tamaño del vóxel, mm", "体素大小（毫米）";
        edge: "{0} of a voxel, mm", "{0} eines Voxels, mm", "{0} de un vóxel, mm", "体素的{0}（毫米）";
        fits: "The size fits the file to the byte", "Die Größe passt aufs Byte genau", "El tamaño coincide con el archivo byte a byte", "尺寸与文件完全吻合";
        over: "{0} bytes of the file are left over", "{0} Bytes der Datei bleiben übrig", "Sobran {0} bytes del archivo", "文件多出 {0} 个字节";
        under: "The file is {0} bytes too short for this", "Die Datei ist dafür {0} Bytes zu kurz", "Al archivo le faltan {0} bytes para esto", "文件比所需的少 {0} 个字节";
        packed: "The file is packed: whether the size fits shows when it is read", "Die Datei ist gepackt: ob die Größe passt, zeigt sich beim Lesen", "El archivo está comprimido: al leerlo se verá si el tamaño coincide", "文件经过压缩：读取时才知道尺寸是否吻合";
        too_large: "This is more than can be opened", "Das ist mehr, als geöffnet werden kann", "Es más de lo que se puede abrir", "超出可打开的范围";
        open: "Open", "Öffnen", "Abrir", "打开";
        cancel: "Cancel", "Abbrechen", "Cancelar", "取消";
    }
}
