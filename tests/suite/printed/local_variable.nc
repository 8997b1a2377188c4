; run: exit 0
; page 15557122699 local variables (V.L)
; end X10
#VAR
V.L.LOC_VAR
#ENDVAR
N10 V.L.LOC_VAR = 10
N15 G00
N20 XV.L.LOC_VAR
N30 M30
