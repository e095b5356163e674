// SPDX-License-Identifier: MIT
// Written by `limitcheck_make_plan 1`, and not to be edited.
#include "data/generators/planned_stars.h"

namespace limitcheck::data {

// clang-format off
const std::vector<PlannedStars>& planned_stars(bool triangles) {
  static const std::vector<PlannedStars> loop{
      {"780ch:wJaBdkJghAfJmcbDJn_or.dbgBhknecf.AamD._vJwknmk_r.K.K.JDKJh_rdfeBAkhgD_rvg.D.b.ac..eg.g.4mB.3A.4k.hdf.._rncKgDKdKkaebmfBKA_orva.nJJa._wDamcbkgdAfheDB_rvnJBJh.g.K_or.6D..d..c..fBan.kK.ge.hm.3bA._orvK.n..mJ._or.8BK._rJ.Kk", 2, "random:99"},
      {"541h:vJwJbahKKAkBDmKecngfd_wKJmbnkcaAdKK_rBmJDJfnhgeak_r.3gJ..hfJe.B..a.7A..J.4c.b.4k.6n..dD.m.12_rvAJBJgKhK_vAwgKDh_rJ.eJJK.J_rve.AJK.dKJKe_ovJwJ.JK.K..J._rvf.25h.14B..A.4m.21J.K.K..dDk..e.6fg.a.3cb.n_or.3b.8e.6B.4ck.f.6m..g.JA.5Dn.9h.5ka._rvbmKn.KK._orvd.3_wKKkcDaKmnb", 0, "uniform"},
      {"383h:vKwbAJKdc_owAza.JJ.JKJ._rvJKcdA_JKmK_vgKkK3_rfgK3.JBJ_rvf.JKJm_rvJKhKgJ_rvAJ.DJ.JKKk_rvkJnaJ.b_r.3KghB.._rAKKdKK_rKbednaJgcAm_orvK..b.J.5c..", 3, "random:1"},
      {"633ch:or.AhgDndmBaefk._rvKJanbJ4_r.J..eA.3d.6m.13D.11J.11B.3na.4f.32c.3g.4J.7kb.3K.8h_or.hkKDeKKBdfg._ovKwh.J..D._vJwK..JDK_or..JKJ.aKK._r.3K.4J.19K.4_orvK.Jn.e.J.5d..g.5h.5c.a..KKAD.7fm..J..k.4b.4B.5_vDwnJhKDJKJ.k.._vcwee.._ovDwf.e.f._rvKKcbnKdKamA_vkwJ..K..J.7", 1, "uniform"},
      {"103ch:r.cJ.a.b_rvB.65_rvKaJ.n_or.mca.D.kf.Kd..e.bn.B..Kg.4Jh.3A._rvd.4fe.10_rvJJ4eK_rvJJKJ_r.12A.11d.19k.h.24e.25J.29K.12mb.7f.18K.12n.12DA.31c.9B.15g.._rvKJKJD_r.cA.KJJ_orvf.11A._rvJ.gJK.JB.K_or.3a.3g.m.3b..B.9D.6h.6f.k.6d.3e.12c.10A.19n.3_KKanb", 1, "uniform"},
      {"751c:rvJakAmeDcbdfn_rvmfJBgJ_orvJ.3k.39J..J.J.6K.9_owd.Acbnfamde._rvKJD..K..h_orvA.18_vdwmm.J.k..KK.KJ_or.KhKJJgK.._rvdbJJ_vJwBcb._vKb.12_vgdBeJ_rvK.KA_orvK.5n.8", 1, "uniform"},
      {"87ch:or.6a.K.n._vaweBga_orvB.35A.15K.78_rvJ.9K.19K.4_r.17J.5K.21J.7k.10K_rveKK..J3._or.6K.f.8_rvKAKcK.K3_or.26K.38_ovJwa.ba.._wB.k.K..D.J.3J_rJ3K_vhwfK.JJ.e.f_rvJ.40g.4f.91J.109B.8", 0, "uniform"},
      {"692:rvhghD_r.20D.13_vKwJBKf_orvK.hd.4ABf..bg.4k.6naDmc.e.._ovJzd.3_wKKBefK3_wKkD.JJK3_ovJwJ.g.JBJ.._rvJJ3KJ_orva.mn._orvn.hgK._rvK.B.9_vdKJKbKc_rvJKJJKnm.a.", 2, "random:1"},
      {"416:or.15A.11d.6_orvJ.anmBgbe.fADhcdk._rvk.8D.4_zmK.b..aJ.._r.7K.J.6_or.7J..k.3_ovBwK..JK..k._rvaJ..m._rvD.Kh.D.K_wKzhJK.JfJde_ovcwd.Kd._wDzBKJJ.b_vgwKKK.JfKJ_orvJ.dK..K.KA.K..", 1, "uniform"},
      {"175ch:rd.K.JK._orvm.e..cK.K.3kfA.DB.3gJ.hJa.bmdn.J._rvK.gBJ.K.hJJ_orvd.JJ._orvd.._orvb.8K.3_wmKK.._rvJJJKKc._rvJaKJbK_rve.cKb._rvaJJKJ._rvB.kJ.m_rva.4JJ.4K.J_rveJKf..J", 4, "random:97"},
      {"420:orvK.bJK._ovmwB.KJhg._orvb.5f.38b.32c.7a.33e.17k.7d.9B.11h.40g.14n.m.18A.4D.7_rvK.K.KAJ_owJ.JdeJ.K._rvKfKJe_rva.4K.JJ._or.10J.n.3J.47K._or.38J.15K.46_rJDKJk._rvK.5D.119h.3_orvK.3a._or..KKh.7J.14J.6_orvg.10f.54", 1, "uniform"},
      {"883:rvKJ.4_rvK.J..B._rvK.31J.K.11J..K.26b.K.22_orvJ.._vcwg.DJ.K_or.13c.19A._ovKwJ..J._orvJ.K.6B.3_vKwJ.Jh.JJkJDJ_rve.21m.J.K.10K.10kK.12K.._rvJKJdK.J_r..e.JJ_rvahD.._rvJ.K.3K.3K.3K..", 1, "uniform"},
      {"613c:orvA.3Khg.._rvJJd..mB.3eb.6k.8a.3n.7K.g.13f.3Ac.3Dh_r.3gK.3K.3K.7KK.12_wmzD.5K.J.._wD..KJ.g..J.h.D.JK_or.4D.37K.36h.21_r.7K_rKnmJJkKJ_r.18K.7f.20K.4K.14J.11B.20_orvk.Ka.K._rvc..K.3_rK.K..J.KJ.4_vmB.fK.J_or.14c..b.18J.46K.35J.10", 0, "uniform"},
      {"126c:rveK.e_rkDK._rvdKmKnKkK_vKzm.11_rvaJJ.J.KJe_r.7K.26_rvcgJ4B_rvKm..k.n.4K._r..K.JJ..J..K.5_rvnKKJK.a_rvKmBhankfbADJged..c_r.5K.nb.15J..J.J.3a_vAzd.J.6K.3_r.33K.19J.75", 2, "random:51"},
      {"714h:rJ.3KJ.A.J._orvg.99K.12J.22K.58a.40K.21_rvKJ.JJdK.A_rvKb..an_vKweJ.eK_rvmgJBf_or.gDbhBcdeAkm.af.n._or.20K.9J.3_r.6KK.40a.3n.203_vJAKKcJKK_ovKzA.17_r.18K.K.43_wJzd.5J.4K..", 0, "uniform"},
      {"2h:or.hfncagkdBeDAbm.._rvJ..n.49a.12_or.8J.7KKmh.4f.7e..c.4D.6B.9b.5J..g..kJd.28A.n.13a.13", 4, "random:66"},
      {"991c:r.10", 2, "random:72"},
      {"696:rvJJfmdBabhkegDn", 2, "random:75"},
      {"258:rvKmfgDhJKnkeBd", 2, "random:11"},
      {"627c:or.D.15", 2, "random:53"},
  };
  static const std::vector<PlannedStars> quads{
      {"465:vJwdcghBfkeDdmA/9_rvmK.KJ.._reKBfAKdKgc/10_rvKbaKn_rfJemkgncadbJJBhA_rvf.K.kh.KDK_ovh.g.K./12_rvbABe.Kbf.gcJda_rvk.kJ.J./10_or..b.3e.4kAdKJ.gn.3c.f.a..BDhm./8_r.KDK..J/13_redKBfAchg/16_rK.6J/100_rJ3cAJ", 2, "random:48"},
      {"462hs:rvJgJKJ.hDK./64_orvk.3d..c..h.3e..n.m.6A.4g.6a.10J.4kB.3f.Db.3/7_rvA.3/34_or.JKDdabAJJekncmJ._rgfB/256-3_or.e.3h.4b.3A.10mn.7k.d.10g.Df.cB..a.9/3_or.Jg../11_rK..K/33_or.KK.K.m.K./6_or.mn.K./17_rvgK.3J.5K/5_rvc.9ed.K.4_vewJgJ.BfJ./65-3_reh..kmc.B..b.a.4d..fg.nA.3J.D..", 0, "uniform"},
      {"649cs:rh.D.7_vJwKk..K.m/7_ovbwb.cJJKK.J..b._rJJk/17_rKJbKanK/17_or.KKJ.K./33_rvJA.d.3/12_rcBgbmDnakefh/64_rK.KaJ.B./17_vBzn..g.hD_rvm.dm_or..Knm../9_rvJ.K..KcJ/7_rvA.4Bn.14bk.7c.3mKd..h.3g.K.5aA.4D..eJf.3/5", 2, "random:30"},
      {"213:or.ahe.mfbkgdc.nbBA._r..eKK.KJ_or.Km../34_orvK.b./9_rvhJeKKJfJ_rvg..m..J.kJ/10_rnJJdK./11_or.h.3J.7_orvK..k.3D./33_r.D.3/101_rvehc.g/100_rvK.J.JK/64_rKmJJ/65_rvdJ.J.3cA..K/8", 3, "random:14"},
      {"313ch:vnwAbJKJcJ.3K_rDJK..J/256_rvJ.a.mn/11_rJ..J./16_rfDBJcAJhbJdKganmk_rvK.f..d/13_r.7J.4d.4h.4e.5c.Bn.5b.3A..k.22m.4K.7f.3a.6D.3k.4/6_rkJKmKJnK/3_rJ.4K../9_rvcgK.KJKBJ._owK.DK5../8_orvJ.K.b.c.3_or.JknhgbDma./3_or.mKkJKJJ./11", 2, "random:36"},
      {"408cs:vhwgcAdKJ3/9_rvJmeBKKJfDkghn/256_rvhJ.JKJDJ.mk/16_wkdhKfbeDBkmA.nacg_rvJ.DJ5hg./34_rkKKDJ/100_wKmBgDhkabfnc/10_rJJ.BK.Ag/65_vhwhaBcbAfmgdken/101_r.28e.10n.6B.28m.62c..A..f.4D.22d..b.48k.6a..h.11g.9/7_wJKKJ/64-3_rfkbmncBeAda/33_or.eh./100_or.7g.5D.12e.16d.3a..Ah.16k.4n.13c.9mb.11B.7f.11/4", 0, "uniform"},
      {"232s:vKwJbbKK/34_r.kK.K./13_owB.gf.B./13_r.ma.J.3Kn/65_ovBzf.17_zm.cAd/16_rKK.nJJ../3_vhza.gBh../17_rvJ.J.13A.5J.11/3_orvB.28K.6_or.kJJKD./6_rvK.J.26K.5/8_or.10/100_ovbwK.A.4c../7", 0, "uniform"},
      {"703cs:vJwnJm.nKJ..K_rKmKn./10_orvK.6n../34_rvK.n../100_r.f.e.4J/13_rvKh.J.dJK./11_vBwhB.J/12_rveh.3/65_vaK3eJ_r.10/3_.5/7-3_rJ3K/12_or..bK.3_rvK.n.J./12", 1, "uniform"},
      {"889cs:or..m.g.bdB.fa..cnh.6k.3A.e..D../3_vewnBehdgAcbfa/11_r.13bg..n.7BaA..ec.6h.3k.5Df.5d.7m/6_rvcb.3c.kB.D.4An..ehf..dm.3g..a./9_ovJwK.K3.K.D../7_vgwDDJK_raK.K./256_orvn.an.4_ovnwc.h.9/3_rvccakdhnAmDb/256_rvKJKJJAdJ/7_rfAngamDdkchBe/9_or.nA./100_vmwJ.KJKJ/13", 2, "random:0"},
      {"131c:rKJJK/101_rvJKKJhK/5_vbwfe..f.4/6_vka.4J..K3n._rvK.kJ.cK/65_rvJaJ.n.bJ/12-3_orvg.38g.59J.107B.50/8_own.na./9-3_r.3K.eK.3K.7f.15/3_rvK.K./101_rvK.3bKac/17_orvK.5J.3K.11J.9KK./5_rve.JJnaJ.m/33_r.64/3", 0, "uniform"},
      {"2chs:o.haDnbfgkmcB./12_rvDKgbhkmKDnKKa_rk..Dm./6-3_orvB.d..K../17_rvK.3AKdKc/16_rn.3Km.a.J./16_rvJJ5._ovJzK.3_rvn.12J.4/8_r..JKK/9_orvK.4/10_rvc.30K.14J.19_rvcK.J3.K/6_rJKdJJK", 1, "uniform"},
      {"128:rKKJKJ/101_rvbJJ.KK.Jn_rva.3A.._rK.8K.5e.10K..J.3J_orvJ.4J.8/17_rvk.10J..k.D/7_or.edabAmnc./3_rvKJhBJ.Kg_wD..D..h.6/10_rvmdgfAbckDhaeB/34_rg.h..J.J/13_rvKhnAgcafkmbeJB.DJd_za.3bna./34_orvK.K.J.KJ./34", 2, "random:20"},
      {"968:r..eaJf/100_rvK.4JJK.8K_ovcwD.9B.4_rvKk.m/13-3_rekJhKBgDfK/12_vDwcKJKm_vJzKcJ.KJ.b./10_or.7e.10K.5K.K.28J.9_ADaKnbmkcK/13_rvnnABhmDcbfgkaeKd../7_rvKJKKcbK_orvJ..BJ._rnDJKgKkmabhc/33_rvKK.JJ.J/8", 2, "random:24"},
      {"562c:or.4J.D.21k.5/6_r.K.K.K./16_vaK.h.3g.J/5_r.129/7_rvJ.84a.44/3_rvJ..KJJKJA./6_rvg..ke.dbanABfh.D.J.gm.c.10K./7_r.5K./10_or.emhBdcfgkAD./65_rKK.n.KK.J.m../7_or.6n.4A.14k.5f.5a.10eB..D.dc.b.7m.26gh.6/3_rd.e.3/256-3_rhceAbdgKBfDk/16_rvK.6J..Ka/17", 0, "uniform"},
      {"356cs:or.J.D../11_rvK.4J.7J.6A.3J.J.4ed._vnwKe.KfKK/16_r.mJan.J./34-3_vd..D/17_orvk.J.Ja._orvK.J..Jd.e._or.K..KJKeK./9_orve.5K.65J.18K.10/5_rvf..m.4K/64_wJ.J.3J.8J../3_we.7KK.7/6_or..n.9K.5/5_vBzh.4K.3J../3", 0, "uniform"},
      {"878h:rvDb..K./16-3_r.3Ja.k..f.4e.4c.7dm.nB.3g.A.3K.11J.D.h.3Jb.._rKJKmD.3Jk/3_.J.9/12_or.a.A.3m.8D.14bg.4K.B.15h.7c.9n.4e.29k..fd.17/6_r.5/34-3_rk.K..mD/64_rmAdDcknaeb/101_r.n.4a..bd.10h..g.c.4k.e.m.4f.K..DA..B.3K.4K.5/9_rJKabnK3/100_or.DcnbaJmkgh./34_rvK.10Ka.45n.6/9_rvB.14J.10c.19A.11K.26J.15/7_orvK.11bK.15a.5c..A..B.4Dg.16k.hd.15n.25f.9e..m.8/8", 0, "uniform"},
      {"578s:ovhzm..A.3/7_.JK.g..hK3./3_orvK.mAfdbcekDhna./3_r.5/5-3_or.KJKKJ./10_or.fK../17_rJ.JKJJ./13_vJzJ.K.D.Kk/13_orvh.KaJ._rvK.17K.12K.23K..e.3K.K._or.6c.A.8/5_r.5a..b./64_r.8J.K./8_orvD..c..A./64", 1, "uniform"},
      {"336hs:orvK.JJBf._or.AkamcBendKfb._rvAAc._wJK.KJK./11_r..J3/65_or..KJ.JK./10_rvJ..b/65_r.4fJ.5/13_orvc.._vK.kKJ..JmD/17-3_ovKza.13/7_or.fJJK..K./16_rvdDh.3/16-3_rvgKKhJ.K/4", 1, "uniform"},
      {"984:rvk.25J.41K.39J.9K.11_wJKJ.7J/7_r.4J.BKf../101_rvk.13J.J.K.15/3_r.4c_vK..bK3.K_orvJ.KJ.B._rmBdfeankDhg/100_wB..cA./33-3_wKnm.JKJ/101-3_.eBf/17-3_r.3B.f.8e.5h.13bga.6m.c.3k.4KnD..d.A.3/6_r.4JK.5J.4/9_r.J.7/33", 0, "uniform"},
      {"493cs:rvk.4JJcK../33_rK..K.4K.4_vdwanK..ba_or.12/11_ovm.A./5_or.3b.4k.21d.5A.16mg.5K.a.5e.5D.5n..B.7ch.4f.3/9_orvK.dfAgnacbmBe./13_r.B.hg/13-3_orvJ.aAcdefbn./65_J3KD_rDKheAgdfJcB/65_r.5b.ca/11_r.20K.9e.J.8dJ.22/8_rAefBkdcDgh/6", 0, "uniform"},
      {"160cs:ovK..g.7K.6/3_or.mA.6D..B.g.5fh..d.7b.3c.10a.14nke./9_rvD.10/100_rvJ.30a.76J.60J.14K.72_vJwnzk.4KK.3mn.._rvKedf/9-3_rvJK../11_rb..f.5mB..a.6D.d..A.6n.3K..eK.3c.g.15hk/5_rvK.6/34_zKkKJ.m.K.K_rnBkKhmDfKg/5_ozf.J.K.dKKJ.._rvKbdeDnmhAgcBfk/8_rvJKK.J..K.a..", 0, "uniform"},
      {"294:rvBJDKkKKhJ./5_orvJ.KK..KJ.n./100_wmnJ./6", 4, "random:27"},
      {"621h:rvKDJ.6/5_or.5D.k.16A.4B.4gbn..h.13c.3J.6m.11K.7Kf.3e..d..KK..a._rK.JKKJ/64_or.70J.10f.109B.65/3_orvB.3J.KK./34_or.9/12_rKJKKcJ/12_or.34/7_rvJ.7/256_rdbDmnkaAc/8_orvJ.18/9_rvA.d.K..bhf.17e.15g..J.J..B.9a..J.6n.c.11k.4D..m.A.5_r.5/10-3_rvJK3DKkJ/65", 0, "uniform"},
      {"366chs:orvJ.11f..J.ahD..b.3n.5c.9e.d.14A.3B.12m.4g.18k./8_r.4fe..B/12_vDkm.K../5_orvJ../5_waJ.J.KanK.J/17_rB.3e..c.4k.f.Kb..m.gD.danhJ.KA./9_or.14/6_o.n./8-3_or.8A.4/9_rK.Ke/12-3_rvc.4KK.32J.14a.J.6J./4_rK.108K.19/5_or.dJ.3/64_or..K.4K.JK.3J.3/3", 0, "uniform"},
      {"382s:orvK..g._r.5/33-3_regfAdBbcKh/9_or..ba.3/10-3_r.6/16_.Ka.3/11-3_r..Dk.12m/6_r.6/12", 4, "random:23:visible"},
      {"5h:orvJ.5J.15K3.11_wk.mJ.nk./11-3_rvJJgA/17_rvKaJK.bKn.JJ_vDwKnKmKKJ_rvJ.KaKJ._rvb.9e/8_rdef/33_zf..m.3/12_r..g.B/64-3_or.de.7/101_r.JK4/33_or.AdKfgBhe./34_rvJK.7/256", 1, "uniform"},
      {"945chs:or..J../101-3_r.ce..A.5D.6b.mk.7g.d..hn.6f.7J.J.3B..a.3K/3_r.7/101_r.27J.23K.20K.56/3_or.KKJ.K./65_rK.KK.K/256_rvK..K.17K.J.11/6_r.8/101_rvhmJkhKDabgAcn/11_r..B.3/100-3_orvK.J.JJKJ.3/256_rvK.3m/256_or.20b.80_orva.fc.aDAdkBhbgmen./8", 0, "uniform"},
      {"537chs:rvJ.17e.51d.59/4_vKzd.4/33_r.11/64_rvJ.5De.7JK.6B..mJ.3k.7n.3dg.14c.3J.3a.6A.9b..K.11f.23h.6_r..e.cg.n.4fmk.DAd..hab.8B./5_r.100/3_r.13g.J.10e.5d.20h.3D..f.20ab.13A.6B..k.8c.4m.3n.4/9_rvk.12/100_r.49K.99J.43J.23K.38/6_r.16dA.46/8_r.7/100_rvK.24c.34m.36b.3e.13D..kK.20f.14n.24J.3g.25a.6h.14B.9d.6A.7/9_rvK.11/256_wnzJ.na/101", 1, "uniform"},
      {"158chs:or.K.KgK.._o.g..J._or.K.3_or.a..JK._or..KcKKA..", 4, "random:6:visible"},
      {"310:r.5/65-3_orvk.bK.Jc._or.3D../100-3_or.3k.3h.3c.17e.7g..d.mA.11a.B.f.b.nD./3_rhdAcen.afmBg.k.Db/3_vezak.Dh/65_or.66/7_vkzcJ.3/100", 0, "uniform"},
      {"504ch:rvA.12c.26g.25B.21h.43k.48fe.D.18m.15A.4b.28a.dn/5_zB.JJ./256", 0, "uniform"},
      {"7c:vdwkBDca.nhm.fdebgAk", 3, "random:29"},
      {"507cs:r.3/13", 4, "random:39:visible"},
      {"274:r.4/3", 4, "random:19"},
      {"912hs:r.30c.173b.15a.35/3", 1, "uniform"},
      {"567:rvf.3K.5", 2, "random:30"},
      {"956s:r.J..m.3k..", 2, "random:43"},
      {"665:rnfBaDgcAhbed", 2, "random:30"},
      {"381s:r.16", 2, "random:90"},
  };
  return triangles ? loop : quads;
}
// clang-format on

}  // namespace limitcheck::data
