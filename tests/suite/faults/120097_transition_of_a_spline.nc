; check: exit 1
; error 120097 at 3:20
#SET ASPLINE MODE [9,1]
M30
