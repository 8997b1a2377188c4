; run: exit 0
; page 15557122699 local variables (V.L), second form
; end X10
#VAR
V.L.LOC_VAR = 10
#ENDVAR
N20 G00 XV.L.LOC_VAR
N30 M30
