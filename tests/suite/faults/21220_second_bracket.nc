; check: exit 1
; error 21220 at 4:26
; error 21220 at 5:9
#VIB GUARD ON [MODE = 2] [FREQ = 30]
#MCS ON [EX TOOL]
M30
