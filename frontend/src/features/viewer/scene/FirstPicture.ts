import { useFrame } from '@react-three/fiber';
import { useRef } from 'react';

interface FirstPictureProps {
  readonly onDrawn: () => void;
}

/** Reports once that a view has drawn its first picture. */
export function FirstPicture({ onDrawn }: FirstPictureProps) {
  const isDrawn = useRef(false);
  useFrame(() => {
    if (isDrawn.current) return;
    isDrawn.current = true;
    // The renderer draws after this callback, in the same task.
    queueMicrotask(onDrawn);
  });
  return null;
}
