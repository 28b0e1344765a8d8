import { Menu } from '@mantine/core';
import { useEffect } from 'react';

interface PointTargetProps {
  readonly x: number;
  readonly y: number;
  /** The name of the menu. */
  readonly label: string;
  readonly onClose: () => void;
}

/** Opens a menu at a point of the window, where the pointer is. */
export function PointTarget({ x, y, label, onClose }: PointTargetProps) {
  // A menu receives Escape only while it has the focus, which it gets a moment after it is shown.
  useEffect(() => {
    const closeBeforeFocus = (event: KeyboardEvent) => {
      if (event.key !== 'Escape' || document.activeElement?.closest('[role=menu]')) return;
      event.stopPropagation();
      onClose();
    };
    window.addEventListener('keydown', closeBeforeFocus, true);
    return () => window.removeEventListener('keydown', closeBeforeFocus, true);
  }, [onClose]);

  return (
    <Menu.Target>
      {/* Hidden from screen readers: no role describes a point that opens a menu. */}
      <span
        aria-hidden="true"
        aria-label={label}
        style={{ position: 'fixed', left: x, top: y, width: 1, height: 1 }}
      />
    </Menu.Target>
  );
}
