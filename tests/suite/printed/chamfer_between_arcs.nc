; run: exit 0
; page 206615051 chamfer between two arcs (G301), second example
; end X175 Y-20
; note K-0109 at 5:9
N10 G91 G03 I50 X95 Y-15 F6000
N20 G301 I30
N30 G03 X80 Y-5 I40 J15
M30
