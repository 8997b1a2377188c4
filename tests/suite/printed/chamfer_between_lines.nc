; run: exit 0
; page 206615051 chamfer between two lines (G301), first example
; passes X44.223 Y-22.111
; passes X115.777 Y-22.111
; end X160 Y0
N05 G00 X0 Y0
N10 G91 G01 X80 Y-40 F6000
N20 G301 I40
N30 G01 X80 Y40
M30
