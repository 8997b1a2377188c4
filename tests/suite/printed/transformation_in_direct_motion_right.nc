; run --identity-trafo: exit 0
; page 255167371 diagnosis 21552, right
; warning K-0111 at 8:5
; warning K-0111 at 9:5
; end X100 Y50
N10 G00 X50 Y50
N20 X100
N30 #TRAFO ON
N40 #PTP ON
N50 #PTP OFF
N60 #TRAFO OFF
N70 M30
