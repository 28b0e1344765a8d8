// Writes `types.json` from BehaviorTree.CPP 4.10: registered types, JSON, ports of any type, models and the XSD.
// Link it with a static libbehaviortree_cpp.a of commit 879522c7; it writes one JSON document.
#include <fstream>
#include <iostream>
#include <vector>
#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/json_export.h"
#include "behaviortree_cpp/xml_parsing.h"
using namespace BT;
using json = nlohmann::json;

struct Point { double x = 0; double y = 0; };
BT_JSON_CONVERTER(Point, p) { add_field("x", &p.x); add_field("y", &p.y); }
struct Unknown { int a = 1; };
struct Pair { int a = 0; int b = 0; };
namespace BT {
template <> inline Pair convertFromString(StringView str) {
  auto parts = splitString(str, ',');
  if(parts.size() != 2) throw RuntimeError("not a pair");
  return { convertFromString<int>(parts[0]), convertFromString<int>(parts[1]) };
}
}
static json seen;
static json shown(const Any& any) {
  json out;
  if(any.empty()) return "empty";
  if(any.isString()) { out["string"] = any.cast<std::string>(); return out; }
  const auto type = any.type();
  if(type == typeid(bool)) out["bool"] = any.cast<bool>();
  else if(any.castedType() == typeid(double)) out["double"] = any.cast<double>();
  else if(any.castedType() == typeid(int64_t)) out["int"] = any.cast<int64_t>();
  else if(any.castedType() == typeid(uint64_t)) out["int"] = any.cast<uint64_t>();
  else if(type == typeid(Point)) { Point p = any.cast<Point>(); out["Point"] = { p.x, p.y }; }
  else if(type == typeid(Pair)) { Pair p = any.cast<Pair>(); out["Pair"] = { p.a, p.b }; }
  else if(type == typeid(std::vector<double>)) out["list"] = any.cast<std::vector<double>>();
  else if(type == typeid(std::vector<int>)) out["list"] = any.cast<std::vector<int>>();
  else if(type == typeid(std::vector<std::string>)) out["list"] = any.cast<std::vector<std::string>>();
  else if(type == typeid(std::vector<bool>)) out["list"] = any.cast<std::vector<bool>>();
  else if(type == typeid(std::vector<Point>)) { out["Points"] = json::array(); for(auto& p : any.cast<std::vector<Point>>()) out["Points"].push_back({ p.x, p.y }); }
  else out["other"] = demangle(type);
  return out;
}
template <class P, class V> struct Write : SyncActionNode {
  V value;
  Write(const std::string& n, const NodeConfig& c, V v) : SyncActionNode(n, c), value(v) {}
  static PortsList providedPorts() { return { OutputPort<P>("out") }; }
  NodeStatus tick() override {
    auto done = setOutput("out", value);
    if(!done) { seen["write"] = "refused"; return NodeStatus::FAILURE; }
    return NodeStatus::SUCCESS;
  }
};
template <class P> struct Read : SyncActionNode {
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() { return { InputPort<P>("in") }; }
  NodeStatus tick() override {
    if constexpr(std::is_same_v<P, AnyTypeAllowed> || std::is_same_v<P, Any>) {
      auto got = getInput<Any>("in");
      if(!got) { seen["read"] = "refused"; return NodeStatus::FAILURE; }
      seen["read"] = shown(got.value());
    } else {
      auto got = getInput<P>("in");
      if(!got) { seen["read"] = "refused"; return NodeStatus::FAILURE; }
      seen["read"] = shown(Any(got.value()));
    }
    return NodeStatus::SUCCESS;
  }
};
struct Many : SyncActionNode {
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() {
    return { InputPort<int>("count", 3, "How many."), InputPort<double>("speed", 0.5, "Speed in m/s."), InputPort<bool>("fast", true, ""),
             InputPort<std::string>("label", "a < b & \"c\"", "A text."), InputPort<std::string>("needed", "Needed."), InputPort<>("free", "Of any type."),
             OutputPort<double>("result", "The result."), BidirectionalPort<int>("counter", "Counted."), InputPort<std::vector<double>>("list", "A list."),
             OutputPort<std::string>("key", "{=}", "A key."), InputPort<unsigned>("size", "Unsigned."), InputPort<NodeStatus>("status", NodeStatus::FAILURE, "A status.") };
  }
  NodeStatus tick() override { return NodeStatus::SUCCESS; }
};
struct Seen : ConditionNode { using ConditionNode::ConditionNode; static PortsList providedPorts() { return { InputPort<int>("id") }; } NodeStatus tick() override { return NodeStatus::SUCCESS; } };
struct Once : DecoratorNode { Once(const std::string& n, const NodeConfig& c) : DecoratorNode(n, c) {} static PortsList providedPorts() { return {}; } NodeStatus tick() override { return NodeStatus::SUCCESS; } };
struct Both : ControlNode { Both(const std::string& n, const NodeConfig& c) : ControlNode(n, c) {} static PortsList providedPorts() { return { InputPort<int>("n", 2, "Number.") }; } NodeStatus tick() override { return NodeStatus::SUCCESS; } };

static std::vector<std::string> writers, readers;
static void registerAll(BehaviorTreeFactory& f) {
  writers.clear(); readers.clear();
#define W(ID, P, V, VALUE) f.registerNodeType<Write<P, V>>(ID, V(VALUE)); writers.push_back(ID);
  W("WInt", int, int, 42) W("WOne", int, int, 1) W("WDouble", double, double, 2.5) W("WWhole", double, double, 3.0)
  W("WText", std::string, std::string, "word") W("WDigits", std::string, std::string, "7") W("WBool", bool, bool, true)
  W("WGenInt", AnyTypeAllowed, int, 42) W("WGenDouble", AnyTypeAllowed, double, 2.5) W("WGenText", AnyTypeAllowed, std::string, "word")
  W("WAnyInt", Any, Any, Any(42)) W("WAnyText", Any, Any, Any(std::string("word")))
#define R(ID, P) f.registerNodeType<Read<P>>(ID); readers.push_back(ID);
  R("RInt", int) R("RDouble", double) R("RText", std::string) R("RBool", bool) R("RGen", AnyTypeAllowed) R("RAny", Any)
  f.registerNodeType<Read<Point>>("RPoint"); f.registerNodeType<Read<Pair>>("RPair"); f.registerNodeType<Read<std::vector<Point>>>("RPoints"); f.registerNodeType<Read<std::vector<int>>>("RInts");
  f.registerNodeType<Write<Point, Point>>("WPoint", Point{ 1, 2 });
}
static json run(BehaviorTreeFactory& f, const std::string& body) {
  json out; seen = json::object();
  out["body"] = body;
  const std::string text = "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><Sequence>" + body + "</Sequence></BehaviorTree></root>";
  try {
    auto tree = f.createTreeFromText(text);
    try { out["status"] = toStr(tree.tickExactlyOnce()); }
    catch(std::exception& e) { out["status"] = "THROWS"; }
    out.update(seen);
    auto entry = tree.rootBlackboard()->getEntry("k");
    if(entry) { auto v = shown(entry->value); out["entry"] = v; out["strong"] = entry->info.isStronglyTyped(); }
  } catch(std::exception& e) { out["status"] = "REFUSED"; }
  return out;
}
int main() {
  JsonExporter::get().addConverter<Point>();
  json all;
  BehaviorTreeFactory f; registerAll(f);
  auto w = [](const std::string& id) { return "<" + id + " out=\"{k}\"/>"; };
  auto r = [](const std::string& id) { return "<" + id + " in=\"{k}\"/>"; };
  const std::vector<std::string> scripts = { "k := 42", "k := 2.5", "k := 'word'", "k := '7'", "k := true" };
  auto s = [](const std::string& code) { return "<Script code=\"" + code + "\"/>"; };
  json ports = json::array();
  for(auto& a : writers) for(auto& b : readers) ports.push_back(run(f, w(a) + r(b)));
  for(auto& a : writers) for(auto& b : writers) ports.push_back(run(f, w(a) + w(b) + r("RGen")));
  for(auto& a : scripts) for(auto& b : readers) ports.push_back(run(f, s(a) + r(b)));
  for(auto& a : scripts) for(auto& b : writers) { ports.push_back(run(f, s(a) + w(b) + r("RGen"))); ports.push_back(run(f, w(b) + s(a) + r("RGen"))); }
  for(auto& a : writers) for(auto& c : writers) for(auto& b : { "RInt", "RText", "RDouble" }) if(a.rfind("WGen", 0) == 0 || a.rfind("WAny", 0) == 0) ports.push_back(run(f, w(a) + w(c) + r(b)));
  for(auto& b : readers) for(auto& t : { "5", "2.5", "word", "true" }) ports.push_back(run(f, "<" + std::string(b) + " in=\"" + t + "\"/>"));
  all["ports"] = ports;
  json literals = json::array();
  const std::vector<std::string> texts = { "json:{'x':1,'y':2}", "json:{'x':1,'y':2,'__type':'Point'}", "json:{'x':1,'y':2,'__type':'Other'}", "json:{'x':1}", "json:{'x':'a','y':2}", "json:{'x':1,'y':2,'z':3}",
    "json:[]", "json:", "json:{", "json: {'x':1,'y':2} ", "1;2", "", "json:5", "json:[1,2]", "json:[{'x':1,'y':2},{'x':3,'y':4}]", "3,4", "json:{'a':1,'b':2}", "JSON:{'x':1,'y':2}" };
  for(auto t : texts) for(auto& b : { "RPoint", "RPair", "RPoints", "RInts", "RText" }) {
    std::string quoted; for(char c : t) { if(c == '\'') quoted += "&quot;"; else quoted += c; }
    literals.push_back(run(f, "<" + std::string(b) + " in=\"" + quoted + "\"/>"));
    literals.push_back(run(f, "<SetBlackboard output_key=\"k\" value=\"" + quoted + "\"/><" + std::string(b) + " in=\"{k}\"/>"));
  }
  literals.push_back(run(f, w("WPoint") + "<SetBlackboard output_key=\"k\" value=\"json:{&quot;x&quot;:5,&quot;y&quot;:6}\"/>" + r("RPoint")));
  literals.push_back(run(f, w("WPoint") + "<Script code=\"k := 'json:{&quot;x&quot;:5,&quot;y&quot;:6}'\"/>" + r("RPoint")));
  literals.push_back(run(f, w("WPoint") + r("RText")));
  literals.push_back(run(f, w("WPoint") + r("RGen")));
  all["literals"] = literals;
  auto board = Blackboard::create();
  board->set("int", 42); board->set("big", int64_t(1) << 40); board->set("unsigned", uint64_t(7)); board->set("double", 2.5); board->set("whole", 3.0);
  board->set("bool", true); board->set<std::string>("text", "word"); board->set("ints", std::vector<int>{ 1, 2 }); board->set("doubles", std::vector<double>{ 1.5, 2 });
  board->set("texts", std::vector<std::string>{ "a", "b" }); board->set("bools", std::vector<bool>{ true, false }); board->set("point", Point{ 1, 2 });
  board->set("points", std::vector<Point>{ { 1, 2 }, { 3, 4 } }); board->set("unknown", Unknown{}); board->createEntry("empty", TypeInfo::Create<int>());
  board->set("none", std::vector<int>{});
  all["exported"] = ExportBlackboardToJSON(*board);
  json imports = json::array();
  for(std::string text : { "42", "1099511627776", "2.5", "3.0", "true", "\"word\"", "null", "[1,2]", "[1.5,2]", "[\"a\"]", "[true]", "[]", "{}", "{\"x\":1,\"y\":2}", "{\"x\":1,\"y\":2,\"__type\":\"Point\"}",
    "[{\"x\":1,\"y\":2,\"__type\":\"Point\"}]", "{\"x\":1,\"__type\":\"Point\"}", "{\"x\":1,\"y\":2,\"__type\":\"Other\"}", "{\"__type\":5}", "[[1]]", "[1,\"a\"]" }) {
    for(bool typed : { false, true }) {
      auto b = Blackboard::create();
      if(typed) b->set("k", 7);
      json one; one["value"] = json::parse(text); one["typed"] = typed;
      try { json doc; doc["k"] = one["value"]; ImportBlackboardFromJSON(doc, *b); auto e = b->getEntry("k");
        if(e) { one["entry"] = shown(e->value); one["type"] = demangle(e->info.type()); one["sequence"] = e->sequence_id; } else one["entry"] = nullptr;
      } catch(std::exception& e) { one["entry"] = "THROWS"; }
      imports.push_back(one);
    }
  }
  all["imported"] = imports;
  { BehaviorTreeFactory g;
    g.registerBehaviorTreeFromText("<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence><Script code=\"a := 1; b := 'x'\"/><SubTree ID=\"Inner\" name=\"inner\" c=\"5\" shared=\"{a}\"/></Sequence></BehaviorTree>"
      "<BehaviorTree ID=\"Inner\"><Script code=\"d := 2.5; shared := 9\"/></BehaviorTree></root>");
    auto tree = g.createTree("Main"); tree.tickExactlyOnce();
    json steps = json::array();
    auto note = [&] { json one; for(auto& sub : tree.subtrees) { json entries; for(auto k : sub->blackboard->getKeys()) { auto e = sub->blackboard->getEntry(std::string(k)); entries[std::string(k)] = { shown(e->value), e->sequence_id }; } one[sub->instance_name] = entries; } steps.push_back(one); };
    note(); auto saved = BlackboardBackup(tree);
    tree.rootBlackboard()->set("a", 100); tree.rootBlackboard()->set("new", 1); tree.rootBlackboard()->unset("b"); tree.subtrees[1]->blackboard->set("d", 7.5); note();
    BlackboardRestore(saved, tree); note();
    all["backup"] = steps; all["tree"] = ExportTreeToJSON(tree);
  }
  BehaviorTreeFactory m; m.registerNodeType<Many>("Many"); m.registerNodeType<Seen>("Seen"); m.registerNodeType<Once>("Once"); m.registerNodeType<Both>("Both");
  all["models"] = writeTreeNodesModelXML(m, false); all["builtin"] = writeTreeNodesModelXML(m, true); all["xsd"] = writeTreeXSD(m);
  std::ofstream("fx.json") << all.dump(1) << std::endl;
}
