; run --set S.getriebe[1].nummer=2 --set S.getriebe[1].dynamik.vb_max=72000000: exit 0
; page 208157451 gear change of a spindle (G112)
; end X0 Y0 Z0
N010 G112 S2
N020 M3 S9000
N025 G04 2
N030 M5
N040 G112 S1
N050 M4 S8000
N060 M30
