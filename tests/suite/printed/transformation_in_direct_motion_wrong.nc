; check --identity-trafo: exit 1
; page 255167371 diagnosis 21552, wrong
; warning K-0111 at 7:5
; error 21552 at 8:5
N10 G00 X50 Y50
N20 X100
N30 #PTP ON
N40 #TRAFO ON
N50 #PTP OFF
N60 #TRAFO OFF
N70 M30
