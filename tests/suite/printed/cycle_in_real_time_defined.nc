; check: exit 1
; page 444695307 cycle in real time, defined and started later
; error K-0019 at 5:1
; error K-0019 at 8:1
#RT CYCLE DEF [ID = 17 SCOPE = PROG]
  $IF ONCE V.RTA.ACS.ACT_POS.X > 200
#RT CYCLE END
#RT CYCLE START [ID = 17]
M30
