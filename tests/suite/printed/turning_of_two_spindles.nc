; run -m two_spindles: exit 0
; page 208191499 spindle commands of two spindles
N10 S[M03 REV1000] S2[M04 REV2000]
N20 S[M05] S2[REV1500]
N30 S[M04]
N40 M30
