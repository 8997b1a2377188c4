; check: exit 1
; page 253161099 diagnosis 20981, wrong
; error 20981 at 5:1
#VAR
R20[3][4] = [40,41,42,43, 50,51,52,53, 60,61,62,63]
#ENDVAR
N1000 M30
