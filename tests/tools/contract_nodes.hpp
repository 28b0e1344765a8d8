// Control nodes and decorators whose tick and halt are programs: every call that the contract names, in any order.
#pragma once
#include <sstream>

static std::vector<std::string> words(const std::string& text, char separator)
{
  std::vector<std::string> found;
  std::stringstream stream(text);
  for(std::string word; std::getline(stream, word, separator);)
    found.push_back(word);
  return found;
}

struct OwnControl : ControlNode
{
  using ControlNode::ControlNode;
  size_t count() { return children_nodes_.size(); }
  TreeNode* at(size_t i) { return children_nodes_[i]; }
  void stop(size_t i) { haltChild(i); }
  void stopFrom(size_t i) { for(; i < count(); i++) haltChild(i); }
  void plainHalt() { ControlNode::halt(); }
};

struct OwnDecorator : DecoratorNode
{
  using DecoratorNode::DecoratorNode;
  size_t count() { return 1; }
  TreeNode* at(size_t) { return child_node_; }
  void stop(size_t) { haltChild(); }
  void stopFrom(size_t i) { if(i == 0) haltChild(); }
  void plainHalt() { DecoratorNode::halt(); }
};

template <class Base, bool MARKS>
struct Programmed : Base
{
  using Base::Base;
  static PortsList providedPorts()
  {
    return { InputPort<std::string>("program"), InputPort<std::string>("on_halt", "", "") };
  }
  void note(const std::string& word) { EV.push_back(word + ":" + this->fullPath()); }
  std::string statuses()
  {
    std::string found;
    for(size_t i = 0; i < this->count(); i++)
      found += "IRSFK"[(int)this->at(i)->status()];
    return found;
  }
  std::string next(const std::string& port)
  {
    std::string text;
    this->getInput(port, text);
    const auto parts = words(text, '|');
    if(parts.empty())
      return "";
    int& cursor = CUR[this->fullPath() + " " + port];
    return parts[std::min<size_t>(cursor++, parts.size() - 1)];
  }
  // Returns whether the program ended, with the result in `last`.
  bool step(const std::string& word, NodeStatus& last)
  {
    const size_t i = word.size() > 1 ? (word[1] - '0') % this->count() : 0;
    switch(word[0])
    {
      case 't':
        last = this->at(i)->executeTick();
        note("ticked " + std::string(1, "IRSFK"[(int)last]));
        break;
      case 'x':
        try { last = this->at(i)->executeTick(); }
        catch(std::exception&) { note("caught"); last = NodeStatus::FAILURE; }
        break;
      case 'h': this->stop(i); break;
      case 'a': this->stopFrom(word[1] - '0'); break;
      case 'r': this->stopFrom(0); break;
      case 'm': this->setStatus(NodeStatus::RUNNING); break;
      case 'H': this->halt(); break;
      case 'w':
        if(CUR[this->fullPath() + " wake"]++ < 3) this->emitWakeUpSignal();
        break;
      case 'c': note("children " + statuses()); break;
      case 's': note(std::string("own ") + "IRSFK"[(int)this->status()]); break;
      case '?': return letter(word[1]) == last;
      case '=': if(word[1] != 'L') last = letter(word[1]); return true;
      case 'E': throw std::runtime_error("mine");
    }
    return false;
  }
  NodeStatus tick() override
  {
    if(MARKS)
      this->setStatus(NodeStatus::RUNNING);
    NodeStatus last = NodeStatus::SUCCESS;
    for(const auto& word : words(next("program"), ' '))
      if(step(word, last))
        return last;
    return last;
  }
  void halt() override
  {
    note(std::string("halting ") + "IRSFK"[(int)this->status()] + " " + statuses());
    NodeStatus last = NodeStatus::SUCCESS;
    for(const auto& word : words(next("on_halt"), ' '))
      step(word, last);
    this->plainHalt();
  }
};
