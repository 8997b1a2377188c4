; check: exit 1
; page 444712715 timers in a cycle in real time (#RT CYCLE)
; error K-0019 at 4:1
#RT CYCLE [ID = 17 SCOPE = PROG]
  $IF ONCE 1 < 2
    #TIMER START SYN [ID = 0]
    #TIMER START SYN [ID = 2]
  $ENDIF
#RT CYCLE END
#FLUSH WAIT
#TIME 1.5
$FOR P1 = 0, 4, 1
  #MSG ["%d", P1]
$ENDFOR
M30
