; check: exit 1
; page 558268811 error of the program with values (#ERROR)
; error 455 at 4:1
#ERROR [ID455 RC2 PV1=5 PV2=4.999 PM1=2 PM2=3]
M30
