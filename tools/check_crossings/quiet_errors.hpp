#pragma once

#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include <string>

namespace crossings {

/// Keeps the errors and warnings that a VTK object would print, as one line.
class QuietErrors {
 public:
  explicit QuietErrors(vtkObject& object) {
    listener_->text = &text_;
    object.AddObserver(vtkCommand::ErrorEvent, listener_);
    object.AddObserver(vtkCommand::WarningEvent, listener_);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  class Listener : public vtkCommand {
   public:
    static Listener* New() { return new Listener; }
    void Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* data) override {
      if (data == nullptr || !text->empty()) return;
      *text = static_cast<const char*>(data);
      // "ERROR: In file, line n\nClass (0x…): message\n\n" → "message"
      if (const auto close = text->find("): "); close != std::string::npos) text->erase(0, close + 3);
      for (char& c : *text) c = c == '\n' ? ' ' : c;
      while (!text->empty() && text->back() == ' ') text->pop_back();
      if (text->empty()) *text = "unreadable";
    }
    std::string* text = nullptr;
  };
  std::string text_;
  vtkNew<Listener> listener_;
};

}  // namespace crossings
