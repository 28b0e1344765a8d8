import { useProjectStore } from '@/store/project';

const PICTURES = /\bsensor_msgs\b[^]*\b(Image|CompressedImage)\b/;

/** Returns whether an action of the project uses camera pictures: then the camera is shown by default. */
export function useUsesCamera(): boolean {
  return useProjectStore(({ files }) =>
    Object.values(files).some(({ path, text }) => path.endsWith('.py') && PICTURES.test(text ?? '')),
  );
}
