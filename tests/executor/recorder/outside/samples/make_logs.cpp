// Writes FileLogger2, SqliteLogger, and every change as an own observer saw it, of one run of a tree.
#include <behaviortree_cpp/bt_factory.h>
#include <behaviortree_cpp/loggers/bt_file_logger_v2.h>
#include <behaviortree_cpp/loggers/bt_sqlite_logger.h>
#include <fstream>
#include <iostream>
#include <thread>
using namespace BT;
class Observer : public StatusChangeLogger {
 public:
  Observer(const Tree& t, std::ostream& o) : StatusChangeLogger(t.rootNode()), out(o) { enableTransitionToIdle(true); }
  void callback(Duration, const TreeNode& n, NodeStatus, NodeStatus s) override { out << n.UID() << ' ' << static_cast<int>(s) << '\n'; }
  void flush() override {}
  std::ostream& out;
};
int main(int argc, char** argv) {
  std::string to = argv[1];
  int seed = argc > 2 ? atoi(argv[2]) : 7; bool append = argc > 3;
  BehaviorTreeFactory f;
  unsigned state = seed;
  auto next = [&] { state = state * 1103515245u + 12345u; return (state >> 16) & 7; };
  f.registerSimpleCondition("Way", [&](TreeNode&) { return next() > 2 ? NodeStatus::SUCCESS : NodeStatus::FAILURE; });
  f.registerSimpleAction("Act", [&](TreeNode&) { return next() > 1 ? NodeStatus::SUCCESS : NodeStatus::FAILURE; }, {InputPort<double>("speed")});
  f.registerBehaviorTreeFromText(R"(<root BTCPP_format="4">
<BehaviorTree ID="Main"><ReactiveSequence name="patrol"><Fallback name="free?"><Way name="way is free"/><Act name="turn" speed="0.5"/></Fallback>
<Parallel success_count="2" failure_count="2" name="both"><SubTree ID="Go" name="go there"/><SubTree ID="Go" name="and there"/><Inverter><Way name="blocked"/></Inverter></Parallel></ReactiveSequence></BehaviorTree>
<BehaviorTree ID="Go"><Sequence><RetryUntilSuccessful num_attempts="2"><Act name="go" speed="{v}"/></RetryUntilSuccessful><Sleep msec="30"/><Act name="&lt;arrivé&gt;" _skipIf="true" speed="1"/></Sequence></BehaviorTree></root>)");
  auto tree = f.createTree("Main");
  std::ofstream trace(to + ".trace", append ? std::ios::app : std::ios::out);
  { FileLogger2 a(tree, to + ".btlog"); SqliteLogger b(tree, to + ".db3", append); Observer c(tree, trace);
    for (int i = 0; i < 40; i++) { tree.tickOnce(); std::this_thread::sleep_for(std::chrono::milliseconds(8)); }
    tree.haltTree(); std::this_thread::sleep_for(std::chrono::milliseconds(300)); b.flush(); }
}
