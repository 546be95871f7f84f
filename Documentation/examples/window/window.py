# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's window from within: menus, dialogs, the properties panel, pictures. For programs that
start.py runs. What is done here is what a user's mouse and keys do to the same widgets.
"""

import ctypes
import time

from PyQt5.QtCore import QAbstractItemModel, QItemSelectionModel, Qt, QTimer
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import (
    QApplication, QCheckBox, QComboBox, QDialogButtonBox, QLineEdit, QPushButton, QRadioButton,
    QScrollArea, QToolButton, QWidget)

SECONDS = 60  # that anything may take

#: QCoreApplication::processEvents(QEventLoop::ProcessEventsFlags). PyQt's would release Python's
#: lock, which ParaView takes to be its own while it records a trace.
_process_events = ctypes.PyDLL("libQt5Core.so.5")[
    "_ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE"]
_process_events.argtypes, _process_events.restype = [ctypes.c_int], None


def work(seconds):
    """Lets the window do what is waiting in its queues and timers."""
    end = time.monotonic() + seconds
    while True:
        _process_events(0)
        if time.monotonic() > end:
            return
        time.sleep(0.01)


def wait(condition, what):
    """Lets the window work until condition() is true, and returns what that gave."""
    end = time.monotonic() + SECONDS
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise TimeoutError(f"not within {SECONDS} s: {what}")
        work(0.05)


def settle():
    """Lets the window finish what follows from a click."""
    work(0.3)


def plain(label):
    """A label without its mnemonic and shortcut."""
    return label.replace("&", "").split("\t")[0]


def visible(class_name):
    """The windows of a class of ParaView that are on the screen."""
    return [w for w in QApplication.topLevelWidgets()
            if w.metaObject().className() == class_name and w.isVisible()]


def main_window():
    """Not that of the help, which is a QMainWindow too."""
    return wait(lambda: visible("ParaViewMainWindow"), "the main window")[0]


def menu(*path):
    """The action at a place in the menus, such as menu("Filters", "Footpoint", "Coons Patch")."""
    actions = main_window().menuBar().actions()
    for label in path[:-1]:
        found = [action.menu() for action in actions if plain(action.text()) == label]
        if not found:
            raise LookupError(f"no menu {label!r} on the way to {' > '.join(path)}")
        found[0].aboutToShow.emit()
        settle()
        actions = found[0].actions()
    found = [action for action in actions if plain(action.text()) == path[-1]]
    if not found:
        raise LookupError(f"no {path[-1]!r} among {[plain(a.text()) for a in actions]}")
    return found[0]


def labels(*path):
    """What stands in a menu."""
    return [plain(action.text()) for action in menu(*path).menu().actions()]


def with_dialog(trigger, answer):
    """Calls trigger(), which shows a dialog and waits for it, and answer(dialog) meanwhile."""
    failures = []
    timer = QTimer()

    def look():
        dialog = QApplication.activeModalWidget()
        if dialog is None or not dialog.isVisible():
            return
        timer.stop()
        try:
            answer(dialog)
            if dialog.isVisible():
                raise TimeoutError(f"the dialog {dialog.windowTitle()!r} stays")
        except BaseException as error:  # would be lost in Qt
            failures.append(error)
            dialog.reject()

    timer.timeout.connect(look)
    timer.start(200)
    trigger()
    timer.stop()
    if failures:
        raise failures[0]


def answer_inputs(dialog, chosen, picture=None):
    """In the dialog of a filter with several inputs: {label of the input: name of its source}."""
    for label, source in chosen.items():
        radio, = (r for r in dialog.findChildren(QRadioButton) if r.text() == label)
        radio.click()
        select_in_tree(dialog, source)
    if picture:
        settle()
        picture(dialog)
    buttons, = dialog.findChildren(QDialogButtonBox)
    buttons.button(QDialogButtonBox.Ok).click()


def select_in_tree(dialog, name):
    """Selects a source in the dialog's tree of the pipeline."""
    model, = dialog.findChildren(QAbstractItemModel)
    found = model.match(model.index(0, 0), Qt.DisplayRole, name, 1,
                        Qt.MatchExactly | Qt.MatchRecursive)
    if not found:
        raise LookupError(f"no {name!r} in the tree")
    view = dialog.findChild(QWidget, "pipelineView")
    for selection in view.findChildren(QItemSelectionModel):
        if selection.model() is model:
            selection.setCurrentIndex(found[0], QItemSelectionModel.ClearAndSelect)


def answer_file(dialog, path):
    """In the dialog of File > Open: types the path."""
    name = dialog.findChild(QLineEdit, "EntityName")
    name.setFocus()
    name.clear()
    QTest.keyClicks(name, str(path))
    work(0.3)
    dialog.findChild(QPushButton, "OK").click()


class Panel:
    """The properties panel, which shows the active source."""

    def __init__(self):
        self.widget = main_window().findChild(QWidget, "propertiesPanel")

    def show_advanced(self, on=True):
        button = self.widget.findChild(QToolButton, "AdvancedButton")
        if button.isChecked() != on:
            button.click()
        settle()

    def find(self, name):
        """The widget of an option of the active source, or None."""
        for panel in self.widget.findChildren(QWidget, "ProxyPanel"):
            if panel.isVisible():
                for found in panel.findChildren(QWidget, name):
                    if found.metaObject().className().startswith("pq"):
                        return found
        return None

    def has(self, name):
        return self.find(name) is not None

    def option(self, name):
        """The widget of an option of the active source."""
        found = self.find(name)
        if found is None:
            raise LookupError(f"no option {name!r} in the panel")
        return found

    def set(self, name, value):
        """Puts a value into the widget: text of a combo box, bool, number, or a list of numbers."""
        widget = self.option(name)
        combo = widget.findChild(QComboBox)
        check = widget.findChild(QCheckBox)
        if combo is not None:
            if combo.findText(value) < 0:
                raise LookupError(f"{name} has no {value!r}")
            combo.setCurrentIndex(combo.findText(value))
        elif check is not None:
            if check.isChecked() != value:
                check.click()
        else:
            values = value if isinstance(value, (list, tuple)) else [value]
            edits = widget.findChildren(QLineEdit)
            for edit, number in zip(edits, values):
                edit.setFocus()
                edit.selectAll()
                QTest.keyClicks(edit, f"{number:g}")
                QTest.keyClick(edit, Qt.Key_Return)
        settle()

    def show_top(self):
        self.widget.findChild(QScrollArea, "scrollArea").verticalScrollBar().setValue(0)
        settle()

    def button(self, name):
        return self.widget.findChild(QWidget, name)

    def apply(self):
        """A click on Apply, and all that follows from it."""
        button = self.button("Accept")
        wait(button.isEnabled, "Apply is enabled")
        button.click()
        wait(lambda: not button.isEnabled(), "Apply is done")
        settle()
