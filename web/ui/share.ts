/** Passing a file on to another app through the system, as phones do. */

/** Whether the system takes this file; what it takes depends on its kind, and desktops often take none. */
export function canShare(file: File): boolean {
  return 'canShare' in navigator && navigator.canShare({ files: [file] });
}

/** @throws {DOMException} AbortError when the visitor closes the system's sheet */
export function shareFile(file: File): Promise<void> {
  return navigator.share({ files: [file], title: file.name });
}
