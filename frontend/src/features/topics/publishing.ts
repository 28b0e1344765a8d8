import { create } from 'zustand';

interface Publishing {
  /** The initial values of the dialogue; null while the dialogue is closed. */
  opened: { topic: string; type: string } | null;
}

export const usePublishing = create<Publishing>(() => ({ opened: null }));

export const openPublish = (topic: string, type: string) =>
  usePublishing.setState({ opened: { topic, type } });

export const closePublish = () => usePublishing.setState({ opened: null });
