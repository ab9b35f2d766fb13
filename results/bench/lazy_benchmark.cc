// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <random>
#include "core/contact/depth.h"
#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/shapes.h"
#include "problems/shapes/random_solids.h"
#include "results/bench/report.h"
#include "core/stopwatch.h"
#include "core/minkowski/depth_search.h"
#include "core/minkowski/convolution.h"
using namespace phongpd;
using Eigen::Vector3d;
int main(int argc, char** argv){
  int which = argc>1? atoi(argv[1]):0; double share= argc>2? atof(argv[2]):0.05; int n=argc>3?atoi(argv[3]):100;
  TriangleMesh a,b;
  if(which==0){a=MakeUvBall(0.4,24,22); b=MakeWrench();}
  if(which==1){a=Rotated(MakeWrench(0.4,24,24,20,18),GenericRotation()); b=MakeScan(MakeTorus(2,0.7,60,30),0.1,0.002,3);}
  if(which==2){a=MakeKnot(0.3,0.12,128,16); b=MakeBlob(2,4,0.35,1);b=MakeScan(b,0.12,0.001,3);}
  if(which==3){a=MakeStar(0.5,1.2); b=MakeKnot(0.5,0.225,96,8);}
  std::cout<<a.triangles.size()<<" + "<<b.triangles.size()<<"\n";
  Stopwatch w; DepthQuery query(a,b); std::cout<<"handle "<<w.Seconds()<<"\n";
  {Stopwatch t; internal::GridPair pair=internal::MakeGridPair(a,"a",b,"b"); std::cout<<"grid "<<t.Seconds(); t=Stopwatch(); internal::DepthSearch s(pair); std::cout<<" search "<<t.Seconds(); t=Stopwatch(); auto c=internal::ReducedConvolution(pair.obstacle,pair.reflected_robot); std::cout<<" conv "<<t.Seconds()<<" facets "<<c.facets.size()<<"\n";}
  Stopwatch f; ContactSpace space=BuildContactSpace(a,b); std::cout<<"full "<<f.Seconds()<<" faces "<<space.report.arrangement_faces<<" out "<<space.mesh.triangles.size()<<"\n";
  EuclideanMetric m(space.mesh);
  double diag=ComputeBounds(space.mesh).Diagonal();
  std::mt19937_64 rnd(5);
  std::vector<double> t,faces,wins,turned; double worst=0; int bad=0;
  while((int)t.size()<n){
    auto sp=RandomSurfacePoint(space.mesh,&rnd);
    std::uniform_real_distribution<> u(0,share);
    Vector3d q=sp.position-u(rnd)*diag*sp.normal;
    auto truth=m.Query(q);
    if(!truth.inside|| -truth.signed_distance>share*diag) continue;
    DepthResult r=query.At(q);
    t.push_back(r.seconds*1e3); faces.push_back(r.arranged_faces); wins.push_back(r.windows);
    double e=std::abs(r.depth+truth.signed_distance)/diag; worst=std::max(worst,e); if(e>1e-12||!r.certified) {bad++; std::cout<<"BAD "<<e<<" cert "<<r.certified<<" "<<r.depth<<" vs "<<truth.signed_distance<<"\n";}
    if(t.size()%10==0){RobotPose p; p.position=q; p.orientation=Eigen::Quaterniond(RandomRotation(&rnd)); turned.push_back(query.At(p).seconds*1e3);}
  }
  std::cout<<"ms median "<<bench::Quantile(t,.5)<<" q90 "<<bench::Quantile(t,.9)<<" max "<<bench::Quantile(t,1)<<" faces "<<bench::Quantile(faces,.5)<<" "<<bench::Quantile(faces,1)<<" windows "<<bench::Quantile(wins,.5)<<" "<<bench::Quantile(wins,1)<<" worst "<<worst<<" bad "<<bad<<" turned ms "<<bench::Quantile(turned,.5)<<"\n";
}
