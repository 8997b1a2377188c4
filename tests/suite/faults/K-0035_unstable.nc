; run --set X.getriebe[0].kv=90000 --set X.lr_param.dyn_monitoring_v_err=0 --set X.getriebe[0].slep_max=100: exit 1
; error K-0035 at 3:1
N10 G01 X100 F6000
M30
