; check --set X.getriebe[0].dynamik.a_trans_weight=0: exit 0
; warning K-0107 at 3:28
#VIB GUARD ON [AX_DEV=0.01 ACC_FACT=2]
M30
