/** Hands a file to the browser's downloads under a name. */
export function saveFile(file: Blob, fileName: string): void {
  const address = URL.createObjectURL(file);
  const link = document.createElement('a');
  link.href = address;
  link.download = fileName;
  link.click();
  // The browser reads the address after this task; a minute is more than it needs.
  setTimeout(() => {
    URL.revokeObjectURL(address);
  }, 60_000);
}

/** Whether the system takes this file; what it takes depends on its kind, and desktops often take none. */
export function canShare(file: File): boolean {
  return 'canShare' in navigator && navigator.canShare({ files: [file] });
}

/** @throws {DOMException} AbortError when the visitor closes the system's sheet */
export function shareFile(file: File): Promise<void> {
  return navigator.share({ files: [file], title: file.name });
}
