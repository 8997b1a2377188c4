; check: exit 1
; error 20933 at called/deletes.cyc 1:9
#VAR
V.CYC.A = 1
#ENDVAR
L CYCLE [NAME=called/deletes.cyc]
M30
