; check: exit 1
; page 486167307 V.CYC variables deleted on a level below (#DELETE)
; error 20933 at called/deletes_a_cycle_variable.nc 1:9
#VAR
V.CYC.MYVAR = 3
#ENDVAR
L CYCLE [NAME=called/deletes_a_cycle_variable.nc]
M30
