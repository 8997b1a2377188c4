; Arcs in three spellings and a helix.
%ARC_AND_HELIX
N10 G71 G90 G17 G00 X0 Y0 Z0
N20 G01 X10 F2000
N30 G03 X10 Y0 I-10 J0 Z5          ; one turn of a helix, centre relative to the start (G162)
N40 G02 X-10 Y0 R10                ; half a circle by its radius, clockwise, below the X axis
N50 G161 G03 X10 Y0 I0 J0          ; the other half of the lower side, centre absolute
N60 G162 G18 G02 X-10 Z5 I-10 K0   ; half a circle in the Z-X plane
N70 G17 G01 X0 Y0 Z0
N80 M30
