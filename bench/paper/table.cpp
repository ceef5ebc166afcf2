#include "table.hpp"

namespace endowire::paper {

Table::Table(const std::vector<std::string>& head) {
  row(head);
  row(std::vector<std::string>(head.size(), "---"));
}

void Table::row(const std::vector<std::string>& cells) {
  text_ += "|";
  for (const std::string& cell : cells) text_ += " " + cell + " |";
  text_ += "\n";
}

}  // namespace endowire::paper
