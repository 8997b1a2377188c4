; run: exit 0
; page 208584843 weights of tool life (V.TLM)
; warning K-0100 at 5:1
; end X10
V.TLM.TIME_FACT = 0.5 V.TLM.DIST_FACT = 1.5
$IF V.TLM.TIME_FACT == 0.5
G01 X10 F1000
$ENDIF
M30
